#include "repair/leaks/pull_string.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

/// Does a direction from a point on an edge lead between the two sides that the edge joins?
bool leads_between(const TriangleSoup& soup, const PathPoint& p, const glm::dvec3& direction) {
    const std::uint32_t triangle = p.side / 2, next = p.next / 2;
    const auto& v = soup.triangles[triangle].vertices;
    const auto& from = soup.positions[v[p.corner]];
    const glm::dvec3 axis = glm::normalize(soup.positions[v[(p.corner + 1) % 3]] - from);
    const glm::dvec3 normal = outward_of(soup, 2 * triangle);
    const glm::dvec3 inward = glm::cross(normal, axis);  // along the triangle, from the edge
    const glm::dvec3 up = p.side % 2 ? -normal : normal;
    const auto angle = [&](const glm::dvec3& d) {
        const double a = std::atan2(glm::dot(d, up), glm::dot(d, inward));
        return a < 0.0 ? a + 2.0 * std::numbers::pi : a;
    };
    constexpr double least = 1e-12;
    const double turn = angle(direction);
    if (triangle == next) return turn > least && turn < 2.0 * std::numbers::pi - least;
    glm::dvec3 tip{};
    for (const std::uint32_t w : soup.triangles[next].vertices)
        if (w != v[p.corner] && w != v[(p.corner + 1) % 3]) tip = soup.positions[w];
    return turn > least && turn < angle(tip - from) - least;
}

bool may_leave(const TriangleSoup& soup, const PathPoint& p, const glm::dvec3& direction) {
    if (p.side == PathPoint::none) return true;
    if (p.next == PathPoint::none) return glm::dot(outward_of(soup, p.side), direction) > 0.0;
    return leads_between(soup, p, direction);
}

/// The triangles that a point is on.
bool is_on(const TriangleSoup& soup, const PathPoint& p, std::uint32_t triangle) {
    if (p.side == PathPoint::none) return false;
    if (triangle == p.side / 2) return true;
    if (p.next == PathPoint::none) return false;
    const auto& v = soup.triangles[p.side / 2].vertices;
    const auto& w = soup.triangles[triangle].vertices;
    return std::ranges::count(w, v[p.corner]) > 0 &&
           std::ranges::count(w, v[(p.corner + 1) % 3]) > 0;
}

bool see_each_other(const TriangleSoup& soup, const TriangleTree& tree, const PathPoint& a,
                    const PathPoint& b) {
    const glm::dvec3 direction = b.position - a.position;
    if (!may_leave(soup, a, direction) || !may_leave(soup, b, -direction)) return false;
    return std::ranges::all_of(tree.met_by(a.position, b.position), [&](std::uint32_t t) {
        return is_on(soup, a, t) || is_on(soup, b, t);
    });
}

/// From each point as far ahead as doubling steps get, then closer.
std::vector<PathPoint> leave_out(const TriangleSoup& soup, const TriangleTree& tree,
                                 const std::vector<PathPoint>& path) {
    std::vector<PathPoint> kept{path.front()};
    for (std::size_t at = 0; at + 1 < path.size();) {
        const auto sees = [&](std::size_t i) {
            return see_each_other(soup, tree, path[at], path[i]);
        };
        std::size_t next = at + 1;
        if (path.size() - at <= 64) {
            for (std::size_t i = path.size() - 1; i > next; --i)
                if (sees(i)) next = i;
        } else {
            for (std::size_t step = 2; at + step < path.size(); step *= 2)
                if (sees(at + step)) next = at + step;
        }
        kept.push_back(path[next]);
        at = next;
    }
    return kept;
}

}  // namespace

std::vector<PathPoint> pull_string(const TriangleSoup& soup, const TriangleTree& tree,
                                   std::vector<PathPoint> path) {
    constexpr int most_rounds = 16;
    for (int round = 0; round < most_rounds; ++round) {
        std::vector<PathPoint> pulled = leave_out(soup, tree, path);
        const bool is_tight = pulled.size() == path.size();
        path = std::move(pulled);
        if (is_tight) break;
    }
    return path;
}

}  // namespace transillum
