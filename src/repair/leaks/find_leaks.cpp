#include "repair/leaks/find_leaks.h"

#include "repair/leaks/gap_width.h"
#include "repair/leaks/leak_sources.h"
#include "repair/leaks/pull_string.h"
#include "repair/leaks/side_ways.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_set>

namespace transillum {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t none = 0xffffffffu;

/// What leads from one side to the next: an edge's corner, or a straight way.
struct Step {
    Side to = none;            ///< nearer to outside; Way::outside at the last
    std::uint32_t corner = 3;  ///< below 3: over an edge
    std::uint32_t way = none;  ///< else: index of the way

    bool operator==(const Step&) const = default;
};

/// Straight ways by the sides at both of their ends.
class WaysOfSides {
public:
    WaysOfSides(const std::vector<Way>& ways, std::uint32_t sides) : first_(sides + 1, 0) {
        const auto for_each_end = [&](const auto& visit) {
            for (std::uint32_t w = 0; w < ways.size(); ++w) {
                visit(ways[w].from, w);
                if (ways[w].to != Way::outside) visit(ways[w].to, w);
            }
        };
        for_each_end([&](Side side, std::uint32_t) { ++first_[side + 1]; });
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        ways_.resize(first_.back());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for_each_end([&](Side side, std::uint32_t w) { ways_[next[side]++] = w; });
    }
    [[nodiscard]] std::span<const std::uint32_t> operator[](Side side) const {
        return {ways_.data() + first_[side], ways_.data() + first_[side + 1]};
    }

private:
    std::vector<std::uint32_t> first_, ways_;
};

class LeakSearch {
public:
    LeakSearch(const TriangleSoup& soup, const Scene& scene, double width, const Workers& workers,
               Monitor& monitor)
        : soup_(soup),
          workers_(workers),
          monitor_(monitor),
          tree_(soup),
          graph_(soup),
          diagonal_(diagonal_of(soup)),
          width_(width),
          sources_(find_leak_sources(soup, scene, tree_, 2.0 * diagonal_)),
          ways_(find_ways(soup, tree_, graph_.find_parts(), 2.0 * diagonal_, workers, monitor)),
          ways_of_(ways_, graph_.side_count()) {}

    std::vector<Leak> run() {
        std::vector<std::optional<Leak>> found(sources_.size());
        std::vector<bool> is_done(sources_.size(), false);
        const int tries = graph_.side_count() > 500000 ? 4 : 48;
        bool is_closing = true;
        for (int i = 0; i < tries && is_closing; ++i) {
            find_distances();
            is_closing = false;
            for (std::size_t s = 0; s < sources_.size() && !monitor_.stop_requested(); ++s) {
                if (is_done[s]) continue;
                const std::vector<Step> steps = steps_from(sources_[s]);
                std::optional<Leak> leak = follow(sources_[s], steps);
                is_done[s] = !leak || leak->is_opening;
                if (leak && (!found[s] || leak->is_opening)) found[s] = std::move(leak);
                is_closing |= !is_done[s];
            }
        }
        std::vector<Leak> leaks;
        for (auto& leak : found)
            if (leak) leaks.push_back(std::move(*leak));
        return leaks;
    }

private:
    [[nodiscard]] glm::dvec3 centre(Side side) const { return centre_of(soup_, side / 2); }
    [[nodiscard]] glm::dvec3 middle(Side side, std::uint32_t corner) const {
        const auto& v = soup_.triangles[side / 2].vertices;
        const glm::dvec3& a = soup_.positions[v[corner]];
        return a + 0.5 * (soup_.positions[v[(corner + 1) % 3]] - a);
    }

    /// Dijkstra, from outside.
    void find_distances() {
        distance_.assign(graph_.side_count(), infinity);
        step_.assign(graph_.side_count(), {});
        using Entry = std::pair<double, Side>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
        const auto reach = [&](Side side, double distance, const Step& step) {
            if (!(distance < distance_[side])) return;
            distance_[side] = distance;
            step_[side] = step;
            open.emplace(distance, side);
        };
        for (std::uint32_t w = 0; w < ways_.size(); ++w)
            if (ways_[w].to == Way::outside && !closed_ways_.contains(w))
                reach(ways_[w].from, ways_[w].length, {Way::outside, 3, w});
        for (std::uint64_t taken = 0; !open.empty(); ++taken) {
            if (taken % 0x10000 == 0 && monitor_.stop_requested()) return;
            const auto [distance, side] = open.top();
            open.pop();
            if (distance > distance_[side]) continue;
            for (std::uint32_t c = 0; c < 3; ++c) {
                const Side next = graph_.across(side, c);
                const std::uint32_t back = corner_back(side, c);
                if (closed_edges_.contains(3ull * next + back)) continue;
                const glm::dvec3 m = middle(side, c);
                reach(next,
                      distance + glm::length(m - centre(side)) + glm::length(m - centre(next)),
                      {side, back, none});
            }
            for (const std::uint32_t w : ways_of_[side]) {
                if (ways_[w].to == Way::outside || closed_ways_.contains(w)) continue;
                const Side next = ways_[w].from == side ? ways_[w].to : ways_[w].from;
                reach(next, distance + glm::length(centre(side) - centre(next)), {side, 3, w});
            }
        }
    }

    /// The corner of the side across that has the same edge.
    [[nodiscard]] std::uint32_t corner_back(Side side, std::uint32_t corner) const {
        const auto& v = soup_.triangles[side / 2].vertices;
        const std::uint32_t a = v[corner], b = v[(corner + 1) % 3];
        const auto& w = soup_.triangles[graph_.across(side, corner) / 2].vertices;
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t from = w[c], to = w[(c + 1) % 3];
            if ((from == a && to == b) || (from == b && to == a)) return c;
        }
        return corner;
    }

    /// Which side (by index) of a source is the nearest to outside; none where no one is.
    [[nodiscard]] std::size_t nearest_of(const LeakSource& source) const {
        std::size_t nearest = source.sides.size();
        double least = infinity;
        for (std::size_t i = 0; i < source.sides.size(); ++i) {
            double d = distance_[source.sides[i]];
            if (!source.seen_at.empty()) d += glm::length(source.seen_at[i] - source.position);
            if (d < least) {
                least = d;
                nearest = i;
            }
        }
        return nearest;
    }

    /// From the nearest side on: (side, step) pairs as a chain.
    [[nodiscard]] std::vector<Step> steps_from(const LeakSource& source) const {
        std::vector<Step> steps;
        const std::size_t nearest = nearest_of(source);
        if (nearest == source.sides.size()) return steps;
        for (Side side = source.sides[nearest]; side != Way::outside; side = step_[side].to)
            steps.push_back(step_[side]);
        return steps;
    }

    struct Walk {
        std::vector<PathPoint> points;
        std::vector<std::size_t> step_at;  ///< of every segment
    };

    [[nodiscard]] Walk walk(const LeakSource& source, const std::vector<Step>& steps) const {
        Walk walk;
        const std::size_t nearest = nearest_of(source);
        Side side = source.sides[nearest];
        const auto add = [&](const PathPoint& p, std::size_t step) {
            if (!walk.points.empty()) walk.step_at.push_back(step);
            walk.points.push_back(p);
        };
        if (!source.seen_at.empty()) {
            add({source.position}, 0);
            add({source.seen_at[nearest], side}, 0);
        }
        add({centre(side), side}, 0);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const Step& step = steps[i];
            if (step.to == Way::outside) {
                const glm::dvec3 out = outward_of(soup_, side);
                add({centre(side) + ways_[step.way].length * out}, i);
                break;
            }
            if (step.corner < 3) add({middle(side, step.corner), side, step.to, step.corner}, i);
            side = step.to;
            add({centre(side), side}, i);
        }
        return walk;
    }

    /// Measures the way; closes it where it is narrow.
    std::optional<Leak> follow(const LeakSource& source, const std::vector<Step>& steps) {
        if (!source.free.empty()) {
            const glm::dvec3 end = source.position + source.free.front();
            return measured(source, {{source.position}, {end}}, nullptr);
        }
        if (steps.empty()) return {};
        const Walk whole = walk(source, steps);
        const std::vector<PathPoint> pulled = pull_string(soup_, tree_, whole.points);
        glm::dvec3 narrow{};
        Leak leak = measured(source, pulled, &narrow);
        if (!leak.is_opening) close(source, steps, whole, narrow);
        return leak;
    }

    /// \param narrow set to the place of the narrowest gap
    Leak measured(const LeakSource& source, const std::vector<PathPoint>& points,
                  glm::dvec3* narrow) const {
        Leak leak;
        leak.from = source.name;
        for (const PathPoint& p : points) {
            if (!leak.path.empty()) leak.length += glm::length(p.position - leak.path.back());
            leak.path.push_back(p.position);
        }
        const Gap gap = narrowest_gap(soup_, tree_, graph_.border(), leak.path, width_,
                                      1e-13 * diagonal_, workers_);
        leak.width = gap.width;
        leak.is_opening = !(gap.width < width_);
        if (narrow) *narrow = gap.place;
        return leak;
    }

    /// Closes the step of the walk that passes closest to a place.
    void close(const LeakSource& source, const std::vector<Step>& steps, const Walk& whole,
               const glm::dvec3& place) {
        double least = infinity;
        std::size_t closest = 0;
        for (std::size_t i = 0; i + 1 < whole.points.size(); ++i) {
            const glm::dvec3& a = whole.points[i].position;
            const glm::dvec3 along = whole.points[i + 1].position - a;
            const double squared = glm::dot(along, along);
            const double t =
                squared > 0.0 ? std::clamp(glm::dot(place - a, along) / squared, 0.0, 1.0) : 0.0;
            const double d = glm::length(a + t * along - place);
            if (d < least) {
                least = d;
                closest = whole.step_at[i];
            }
        }
        Side side = source.sides[nearest_of(source)];
        for (std::size_t i = 0; i < closest; ++i) side = steps[i].to;
        const Step& step = steps[closest];
        if (step.corner < 3)
            closed_edges_.insert(3ull * side + step.corner);
        else
            closed_ways_.insert(step.way);
    }

    const TriangleSoup& soup_;
    const Workers& workers_;
    Monitor& monitor_;
    TriangleTree tree_;
    SideGraph graph_;
    double diagonal_, width_;
    std::vector<LeakSource> sources_;
    std::vector<Way> ways_;
    WaysOfSides ways_of_;
    std::vector<double> distance_;
    std::vector<Step> step_;
    std::unordered_set<std::uint64_t> closed_edges_;  ///< 3 * side + corner, towards outside
    std::unordered_set<std::uint32_t> closed_ways_;
};

}  // namespace

std::vector<Leak> find_leaks(const TriangleSoup& soup, const Scene& scene, double width,
                             const Workers& workers, Monitor& monitor) {
    if (soup.triangles.empty() || !has_leak_sources(scene) || monitor.stop_requested()) return {};
    return LeakSearch(soup, scene, width, workers, monitor).run();
}

}  // namespace transillum
