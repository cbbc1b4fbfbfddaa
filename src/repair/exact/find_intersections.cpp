#include "repair/exact/find_intersections.h"

#include "repair/exact/flatten.h"
#include "repair/exact/triangle_meeting.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <tuple>

namespace transillum {

namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

/// Candidates that are looked at together: bounds the memory of meshes with many neighbours.
constexpr std::size_t batch = 1u << 20;

std::vector<Box> boxes_of(const TriangleSoup& soup, const FlatVertices* flat) {
    const double moved = flat ? 2.0 * flat->furthest : 0.0;
    std::vector<Box> boxes;
    boxes.reserve(soup.triangles.size());
    for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
        const auto& v = soup.triangles[i].vertices;
        const glm::dvec3 &a = soup.positions[v[0]], &b = soup.positions[v[1]],
                         &c = soup.positions[v[2]];
        const glm::dvec3 low = glm::min(a, glm::min(b, c)) - moved;
        const glm::dvec3 high = glm::max(a, glm::max(b, c)) + moved;
        boxes.emplace_back(CGAL::Bbox_3(low.x, low.y, low.z, high.x, high.y, high.z), i);
    }
    return boxes;
}

using Candidates = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

void classify(const TriangleSoup& soup, const FlatVertices* flat, const Candidates& candidates,
              const Workers& workers, std::vector<MeetingPair>& pairs) {
    std::vector<std::vector<MeetingPair>> found(static_cast<std::size_t>(workers.count()));
    workers.for_ranges(candidates.size(), 4096, [&](std::size_t begin, std::size_t end, int w) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto [a, b] = std::minmax(candidates[i].first, candidates[i].second);
            if (const auto meeting = meet(soup, a, b, flat))
                found[static_cast<std::size_t>(w)].push_back({a, b, meeting->kind});
        }
    });
    for (const auto& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
}

}  // namespace

std::vector<MeetingPair> find_intersections(const TriangleSoup& soup, const Workers& workers,
                                            std::size_t most, const FlatVertices* flat) {
    std::vector<Box> boxes = boxes_of(soup, flat);
    std::vector<MeetingPair> pairs;
    Candidates candidates;
    const auto flush = [&] {
        classify(soup, flat, candidates, workers, pairs);
        candidates.clear();
    };
    struct TooMany {};
    const auto add = [&](const Box& a, const Box& b) {
        candidates.emplace_back(a.info(), b.info());
        if (candidates.size() == batch) flush();
        if (pairs.size() > most) throw TooMany();  // the search has no other way to end early
    };
    try {
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), add);
        flush();
    } catch (const TooMany&) {
    }
    std::ranges::sort(pairs, {}, [](const MeetingPair& p) { return std::tuple(p.a, p.b); });
    return pairs;
}

}  // namespace transillum
