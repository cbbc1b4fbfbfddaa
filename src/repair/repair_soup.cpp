#include "repair/repair_soup.h"

#include "repair/coarsen.h"
#include "repair/find_defects.h"
#include "repair/resolve_intersections.h"
#include "repair/split_t_junctions.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace transillum {

namespace {

/// Cells of the coarse grid across the diagonal: it moves nothing by more than a third of the
/// default tolerance, and leaves 29 of a double's 53 bits for what is cut on it.
constexpr int coarse_bits = 23;
/// The coarse grid has to be this much coarser than what coordinates are rounded to.
constexpr double room = 8.0;

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
        if (options_.level == RepairLevel::full) {
            meet_in_edges();
            // What is cut may leave vertices close to others again.
            for (int i = 0; i < 3 && close_cracks(); ++i) meet_in_edges();
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
        const std::vector<FaultyFace> faults = find_faulty_faces(soup_, scene_);
        std::array<std::uint64_t, 5> counts{};
        for (std::size_t t = 0; t < faults.size(); ++t) {
            ++counts[static_cast<std::size_t>(faults[t].fault)];
            if (faults[t].fault == FaceFault::opposite)
                soup_.triangles[faults[t].first].both_sides = true;
        }
        if (counts[0] == faults.size()) return;
        std::size_t kept = 0;
        for (std::size_t t = 0; t < faults.size(); ++t) {
            if (faults[t].fault != FaceFault::none) continue;
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
    }

    std::vector<MeetingPair> find_pairs() {
        monitor_.progress({.phase = "intersections"});
        return find_intersections(soup_, workers_);
    }

    /// Until triangles meet in whole vertices and edges only.
    void meet_in_edges() {
        std::vector<MeetingPair> pairs = find_pairs();
        if (first_look_) {
            for (const MeetingPair& p : pairs)
                ++(p.kind == Meeting::overlap ? report_.coplanar_pairs : report_.crossing_pairs);
            first_look_ = false;
        }
        if (pairs.empty()) return;
        TriangleSoup best;
        std::size_t least = pairs.size();
        double spacing = coarse_spacing();
        for (int round = 0; round < options_.rounds && !pairs.empty(); ++round) {
            if (monitor_.stop_requested()) break;
            cut(pairs);
            std::vector<MeetingPair> next = find_pairs();
            const bool helped = 2 * next.size() <= pairs.size();
            if (!next.empty() && (round == 0 || next.size() < least)) {
                best = soup_;
                least = next.size();
            }
            if (!helped) {
                // Rounding makes as many as cutting mends: their vertices are too close.
                const double move = coarsen(soup_, next, spacing);
                report_.largest_move = std::max(report_.largest_move, move);
                told("moved vertices apart or together", next.size());
                spacing *= 2.0;
                drop_faulty_faces();
                next = find_pairs();
            }
            pairs = std::move(next);
        }
        if (pairs.size() > least) {
            soup_ = std::move(best);
            report_.pairs_left = least;
        } else {
            report_.pairs_left = pairs.size();
        }
    }

    void cut(const std::vector<MeetingPair>& pairs) {
        const Resolution done = resolve_intersections(soup_, pairs, rounding_, workers_, monitor_);
        ++report_.rounds;
        report_.faces_cut += done.faces_cut;
        report_.faces_made += done.faces_made;
        report_.vertices_made += done.vertices_made;
        told("cut faces where they meet", done.faces_cut);
        drop_faulty_faces();
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

    /// Joins near vertices, and edges to vertices that lie on them.
    bool close_cracks() {
        const double tolerance = options_.tolerance * diagonal_;
        const std::vector<std::uint32_t> target = find_near_vertices(soup_, tolerance);
        std::uint64_t moved = 0;
        for (std::uint32_t v = 0; v < target.size(); ++v) {
            if (target[v] == v) continue;
            ++moved;
            report_.largest_move = std::max(
                report_.largest_move, glm::length(soup_.positions[v] - soup_.positions[target[v]]));
        }
        if (moved > 0) {
            replace_vertices(soup_, target);
            told("joined near vertices", moved);
            drop_faulty_faces();
        }
        std::uint64_t joined = 0;
        for (int edge = 0; edge < 3; ++edge) {
            const std::vector<TJunction> junctions = find_t_junctions(soup_, tolerance);
            if (junctions.empty()) break;
            joined += split_t_junctions(soup_, junctions);
            drop_faulty_faces();
        }
        told("joined edges to vertices on them", joined);
        if (joined > 0) report_.largest_move = std::max(report_.largest_move, tolerance);
        return moved + joined > 0;
    }

    void orient() {
        const Flips flips = find_flips(soup_, scene_);
        std::uint64_t turned = 0;
        for (std::size_t t = 0; t < flips.turn.size(); ++t) {
            if (!flips.turn[t]) continue;
            ++turned;
            std::swap(soup_.triangles[t].vertices[1], soup_.triangles[t].vertices[2]);
            if (!soup_.uvs.empty()) std::swap(soup_.uvs[t][1], soup_.uvs[t][2]);
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
