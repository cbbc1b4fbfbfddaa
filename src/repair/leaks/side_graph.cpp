#include "repair/leaks/side_graph.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <glm/geometric.hpp>

#include <algorithm>

namespace transillum {

namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

Point point(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

/// An edge's faces counter-clockwise around its direction from low to high.
std::vector<EdgeUse> around(const TriangleSoup& soup, std::span<const EdgeUse> uses) {
    std::vector<EdgeUse> sorted(uses.begin(), uses.end());
    if (sorted.size() < 3) return sorted;
    const auto tip = [&](const EdgeUse& use) {
        const auto& v = soup.triangles[use.triangle()].vertices;
        return point(soup.positions[v[(use.side % 3 + 2) % 3]]);
    };
    const Point low = point(soup.positions[uses[0].low]);
    const Point high = point(soup.positions[uses[0].high]);
    const Point first = tip(uses[0]);
    // 0: with the first; 1: less than half a turn on; 2: opposite; 3: more
    const auto quarter = [&](const EdgeUse& use) {
        const Point p = tip(use);
        const auto turn = CGAL::orientation(low, high, first, p);
        if (turn == CGAL::POSITIVE) return 1;
        if (turn == CGAL::NEGATIVE) return 3;
        return CGAL::coplanar_orientation(low, high, first, p) == CGAL::POSITIVE ? 0 : 2;
    };
    std::stable_sort(sorted.begin(), sorted.end(), [&](const EdgeUse& a, const EdgeUse& b) {
        const int at_a = quarter(a), at_b = quarter(b);
        if (at_a != at_b) return at_a < at_b;
        if (at_a % 2 == 0) return false;
        return CGAL::orientation(low, high, tip(a), tip(b)) == CGAL::POSITIVE;
    });
    return sorted;
}

}  // namespace

glm::dvec3 centre_of(const TriangleSoup& soup, std::uint32_t triangle) {
    const auto& v = soup.triangles[triangle].vertices;
    const glm::dvec3& a = soup.positions[v[0]];
    return a + ((soup.positions[v[1]] - a) + (soup.positions[v[2]] - a)) / 3.0;
}

glm::dvec3 outward_of(const TriangleSoup& soup, Side side) {
    const glm::dvec3 normal = glm::normalize(area_vector(soup, side / 2));
    return side % 2 ? -normal : normal;
}

SideGraph::SideGraph(const TriangleSoup& soup) : across_(6 * soup.triangles.size()) {
    const EdgeTable edges(soup);
    // A face that runs from low to high looks ahead, in the sense of turning, with its front.
    const auto side_ahead = [](const EdgeUse& use) {
        return 2 * use.triangle() + (use.ascending ? 0 : 1);
    };
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        if (edges[e].size() == 1) border_.push_back({edges[e][0].triangle(), edges[e][0].side % 3});
        const std::vector<EdgeUse> uses = around(soup, edges[e]);
        for (std::size_t i = 0; i < uses.size(); ++i) {
            const EdgeUse& next = uses[(i + 1) % uses.size()];
            const Side from = side_ahead(uses[i]), to = side_ahead(next) ^ 1u;
            across_[3 * from + uses[i].side % 3] = to;
            across_[3 * to + next.side % 3] = from;
        }
    }
}

std::vector<std::uint32_t> SideGraph::find_parts() const {
    constexpr std::uint32_t none = 0xffffffffu;
    std::vector<std::uint32_t> part(side_count(), none);
    std::vector<Side> open;
    std::uint32_t parts = 0;
    for (Side first = 0; first < side_count(); ++first) {
        if (part[first] != none) continue;
        part[first] = parts;
        open.push_back(first);
        while (!open.empty()) {
            const Side side = open.back();
            open.pop_back();
            for (std::uint32_t c = 0; c < 3; ++c) {
                const Side next = across(side, c);
                if (part[next] != none) continue;
                part[next] = parts;
                open.push_back(next);
            }
        }
        ++parts;
    }
    return part;
}

}  // namespace transillum
