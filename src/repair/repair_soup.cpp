#include "repair/repair_soup.h"

#include "repair/coarsen.h"
#include "repair/defects/find_defects.h"
#include "repair/exact/flatten.h"
#include "repair/exact/resolve_intersections.h"
#include "repair/split_t_junctions.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace transillum {

namespace {

/// Cells of the coarse grid across the diagonal: it moves nothing by more than a third of the
/// default tolerance, and leaves 29 of a double's 53 bits for what is cut on it.
constexpr int coarse_bits = 23;
/// The coarse grid has to be this much coarser than what coordinates are rounded to.
constexpr double room = 8.0;

/// Beside a length, one that rounding could have made.
constexpr double as_nothing = 0x1p-45;

/// Over the diagonal: more than rounding makes of coordinates that lie in one plane, on any grid.
constexpr double noise = 0x1p-38;

class SoupRepair {
public:
    SoupRepair(TriangleSoup& soup, const Scene& scene, const RepairOptions& options,
               const SnapGrid& grid, const Workers& workers, Monitor& monitor, RepairReport& report)
        : soup_(soup),
          scene_(scene),
          options_(options),
          rounding_{options.rounding, grid},
          workers_(workers),
          monitor_(monitor),
          report_(report),
          diagonal_(diagonal_of(soup)) {}

    void run() {
        drop_faulty_faces();
        if (soup_.triangles.empty()) return;
        if (options_.level == RepairLevel::full) {
            // Faces that pass each other within the tolerance would be cut into slivers.
            if (options_.close_cracks) close_cracks();
            meet_in_edges();
            // What is cut may leave vertices close to others again.
            for (int i = 0; i < 3 && options_.close_cracks && report_.pairs_left == 0; ++i)
                if (!try_to_close_cracks()) break;
        }
        orient();
    }

private:
    void told(const char* what, std::uint64_t count) {
        if (count == 0) return;
        for (RepairStep& step : report_.steps)
            if (step.what == what) {
                step.count += count;
                return;
            }
        report_.steps.push_back({what, count});
    }

    void drop_faulty_faces() {
        std::vector<FaultyFace> faults = find_faulty_faces(soup_, scene_);
        while (close_needles(faults)) faults = find_faulty_faces(soup_, scene_);
        std::array<std::uint64_t, 6> counts{};
        for (std::size_t t = 0; t < faults.size(); ++t) {
            ++counts[static_cast<std::size_t>(faults[t].fault)];
            const bool both_sides =
                faults[t].fault == FaceFault::opposite ||
                (faults[t].fault == FaceFault::duplicate && soup_.triangles[t].both_sides &&
                 share_material(t, faults[t].first));
            if (both_sides) soup_.triangles[faults[t].first].both_sides = true;
        }
        if (counts[0] == faults.size()) return;
        std::size_t kept = 0;
        for (std::size_t t = 0; t < faults.size(); ++t) {
            if (faults[t].fault == FaceFault::back)
                turn(t);
            else if (faults[t].fault != FaceFault::none)
                continue;
            soup_.triangles[kept] = soup_.triangles[t];
            if (!soup_.uvs.empty()) soup_.uvs[kept] = soup_.uvs[t];
            ++kept;
        }
        soup_.triangles.resize(kept);
        if (!soup_.uvs.empty()) soup_.uvs.resize(kept);
        told("dropped faces that repeat a vertex", counts[1]);
        told("dropped faces without area", counts[2]);
        told("dropped duplicate faces", counts[3]);
        told("merged faces wound both ways into one with two sides", counts[4]);
        told("turned duplicates to be the backs of faces with black ones", counts[5]);
    }

    void turn(std::size_t t) {
        std::swap(soup_.triangles[t].vertices[1], soup_.triangles[t].vertices[2]);
        if (!soup_.uvs.empty()) std::swap(soup_.uvs[t][1], soup_.uvs[t][2]);
    }

    [[nodiscard]] bool share_material(std::size_t a, std::size_t b) const {
        return scene_.polygons[soup_.triangles[a].polygon].material ==
               scene_.polygons[soup_.triangles[b].polygon].material;
    }

    /// Without a needle that is too thin to have an area, its long edges would be a crack: where
    /// the short one is as nothing beside them, its ends become one. \returns whether there were
    /// any
    bool close_needles(const std::vector<FaultyFace>& faults) {
        std::vector<std::uint32_t> target(soup_.positions.size());
        std::iota(target.begin(), target.end(), 0u);
        for (std::size_t t = 0; t < faults.size(); ++t) {
            if (faults[t].fault != FaceFault::zero_area) continue;
            const auto& v = soup_.triangles[t].vertices;
            std::array<double, 3> length{};
            for (int i = 0; i < 3; ++i)
                length[i] = glm::length(soup_.positions[v[(i + 1) % 3]] - soup_.positions[v[i]]);
            const auto i = std::ranges::min_element(length) - length.begin();
            if (length[i] > as_nothing * std::ranges::max(length)) continue;
            const auto [first, second] = std::minmax(v[i], v[(i + 1) % 3]);
            if (target[first] == first && target[second] == second) target[second] = first;
        }
        const std::uint64_t closed = join(target);
        told("closed needles without area", closed);
        return closed > 0;
    }

    /// Before the first cut: what overlaps but for rounding is to overlap exactly.
    std::vector<MeetingPair> look(std::size_t most = SIZE_MAX) {
        // Noise is not a crack, and is flattened also where cracks are to stay.
        flat_ = flatten(soup_, (options_.close_cracks ? options_.tolerance : noise) * diagonal_);
        std::vector<MeetingPair> pairs = find_pairs(most);
        if (pairs.empty()) flat_ = {};
        return pairs;
    }

    std::vector<MeetingPair> find_pairs(std::size_t most = SIZE_MAX) {
        monitor_.progress({.phase = "intersections"});
        return find_intersections(soup_, workers_, most, &flat_);
    }

    /// Until triangles meet in whole vertices and edges only.
    void meet_in_edges() {
        std::vector<MeetingPair> pairs = look();
        if (first_look_) {
            for (const MeetingPair& p : pairs)
                ++(p.kind == Meeting::overlap ? report_.coplanar_pairs : report_.crossing_pairs);
            first_look_ = false;
        }
        if (pairs.empty()) return;
        const State before{soup_, report_};
        const bool is_collapsed = collapse_where_it_helps(pairs);
        if (pairs.empty()) return;
        std::vector<MeetingPair> left = cut(pairs);
        if (left.size() > pairs.size() && !is_collapsed) {
            restore(before);
            collapse_short_edges(pairs);
            pairs = look();
            left = cut(pairs);
        }
        State best{soup_, report_, left.size()};
        double spacing = coarse_spacing();
        std::size_t last = pairs.size();
        for (int round = 1; round < options_.rounds && !left.empty(); ++round) {
            const bool diverges = left.size() > 4 * pairs.size() + 1000;
            if (diverges || monitor_.stop_requested()) break;
            if (2 * left.size() > last) {
                // Rounding makes as many as cutting mends: their vertices are too close.
                moved(coarsen(soup_, left, spacing));
                told("places with vertices moved apart or together", 1);
                spacing *= 2.0;
                drop_faulty_faces();
                left = find_pairs();
            }
            last = left.size();
            left = cut(left);
            if (left.size() < best.pairs) best = {soup_, report_, left.size()};
        }
        if (best.pairs == 0) return;
        restore(best);
        report_.pairs_left = find_pairs().size();  // all of them: best.pairs may be of a limit
    }

    /// A repair so far, to come back to.
    struct State {
        TriangleSoup soup;
        RepairReport report;
        std::size_t pairs = 0;  ///< that meet
    };
    void restore(const State& state) {
        soup_ = state.soup;
        report_ = state.report;
    }

    /// Edges too short for their coordinates run through each other, as around the poles of
    /// spheres: cutting them all only makes more of them, slowly. Where most pairs come of such,
    /// they are collapsed instead.
    bool collapse_where_it_helps(std::vector<MeetingPair>& pairs) {
        const State before{soup_, report_};
        if (!collapse_short_edges(pairs)) return false;
        std::vector<MeetingPair> rest = look(pairs.size() / 2);
        const bool helps = rest.size() <= pairs.size() / 2;
        if (helps)
            pairs = std::move(rest);
        else {
            restore(before);
            pairs = look();
        }
        return helps;
    }

    /// \returns whether there are any
    bool collapse_short_edges(const std::vector<MeetingPair>& pairs) {
        std::vector<bool> which(soup_.positions.size(), false);
        for (const MeetingPair& p : pairs)
            for (const std::uint32_t t : {p.a, p.b})
                for (const std::uint32_t v : soup_.triangles[t].vertices) which[v] = true;
        const double tolerance = options_.tolerance * diagonal_;
        const std::uint64_t count = join(find_short_edges(soup_, which, tolerance));
        told("collapsed edges shorter than the tolerance, of faces that meet", count);
        if (count > 0) drop_faulty_faces();
        return count > 0;
    }

    void moved(double distance) { report_.largest_move = std::max(report_.largest_move, distance); }

    /// Puts others in the place of vertices. \returns how many
    std::uint64_t join(const std::vector<std::uint32_t>& target) {
        std::uint64_t count = 0;
        for (std::uint32_t v = 0; v < target.size(); ++v) {
            if (target[v] == v) continue;
            ++count;
            moved(glm::length(soup_.positions[v] - soup_.positions[target[v]]));
        }
        if (count > 0) replace_vertices(soup_, target);
        return count;
    }

    /// \returns what meets after rounding
    std::vector<MeetingPair> cut(const std::vector<MeetingPair>& pairs) {
        const Resolution done =
            resolve_intersections(soup_, pairs, flat_, rounding_, workers_, monitor_);
        moved(flat_.furthest);
        flat_ = {};
        ++report_.rounds;
        report_.faces_cut += done.faces_cut;
        report_.faces_made += done.faces_made;
        report_.vertices_made += done.vertices_made;
        told("cut faces where they meet", done.faces_cut);
        drop_faulty_faces();
        return find_pairs(8 * pairs.size() + 1000);
    }

    [[nodiscard]] double coarse_spacing() const {
        double largest = 0.0;
        for (const glm::dvec3& p : soup_.positions)
            largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        double finest = std::ldexp(1.0, std::ilogb(largest) - 52);
        if (options_.rounding == Rounding::floats) finest = std::ldexp(finest, 52 - 23);
        if (options_.rounding == Rounding::dyadic)
            finest = std::ldexp(1.0, rounding_.grid.exponent);
        return std::max(room * finest, std::ldexp(1.0, std::ilogb(diagonal_) - coarse_bits));
    }

    /// Not at the price of intersections that can't be resolved. \returns whether there were any
    bool try_to_close_cracks() {
        const State before{soup_, report_};
        if (!close_cracks()) return false;
        meet_in_edges();
        if (report_.pairs_left == 0) return true;
        restore(before);
        report_.left.push_back(
            "near vertices and T-junctions: joining them makes intersections that rounding brings "
            "back");
        return false;
    }

    [[nodiscard]] double distance_from_edge(const TJunction& j) const {
        const auto& v = soup_.triangles[j.triangle].vertices;
        const glm::dvec3 at =
            glm::mix(soup_.positions[v[j.edge]], soup_.positions[v[(j.edge + 1) % 3]], j.parameter);
        return glm::length(soup_.positions[j.vertex] - at);
    }

    /// Joins near vertices, and edges to vertices that lie on them.
    bool close_cracks() {
        const double tolerance = options_.tolerance * diagonal_;
        const std::uint64_t near = join(find_near_vertices(soup_, tolerance));
        told("joined near vertices", near);
        if (near > 0) drop_faulty_faces();
        std::uint64_t joined = 0;
        for (int edge = 0; edge < 3; ++edge) {
            const std::vector<TJunction> junctions = find_t_junctions(soup_, tolerance);
            if (junctions.empty()) break;
            for (const TJunction& j : junctions) moved(distance_from_edge(j));
            joined += split_t_junctions(soup_, junctions);
            drop_faulty_faces();
        }
        told("joined edges to vertices on them", joined);
        return near + joined > 0;
    }

    void orient() {
        const Flips flips = find_flips(soup_, scene_);
        std::uint64_t turned = 0;
        for (std::size_t t = 0; t < flips.turn.size(); ++t) {
            if (!flips.turn[t]) continue;
            ++turned;
            turn(t);
        }
        told("turned faces against their neighbours", turned);
        const auto left = [&](const std::vector<bool>& which, const char* why) {
            if (const auto n = std::ranges::count(which, true); n > 0)
                report_.left.push_back(fmt::format("{} faces {}", n, why));
        };
        left(flips.non_orientable, "are part of a surface that has no consistent front");
        left(flips.emits_both_ways,
             "disagree which side is the front, but emit from it: turning them would change the "
             "light");
    }

    TriangleSoup& soup_;
    const Scene& scene_;
    const RepairOptions& options_;
    VertexRounding rounding_;
    const Workers& workers_;
    Monitor& monitor_;
    RepairReport& report_;
    double diagonal_;
    FlatVertices flat_;
    bool first_look_ = true;
};

}  // namespace

void repair_soup(TriangleSoup& soup, const Scene& scene, const RepairOptions& options,
                 const SnapGrid& grid, const Workers& workers, Monitor& monitor,
                 RepairReport& report) {
    SoupRepair(soup, scene, options, grid, workers, monitor, report).run();
    if (report.pairs_left > 0)
        report.left.push_back(fmt::format(
            "{} pairs of triangles meet again each time vertices are rounded", report.pairs_left));
}

}  // namespace transillum
