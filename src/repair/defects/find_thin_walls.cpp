#include "repair/defects/find_thin_walls.h"

#include "repair/defects/triangle_tree.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace transillum {

namespace {

using Pair = std::array<std::uint32_t, 2>;

/// Least cosine of the angle between a wall's two sides, which may face either way.
constexpr double least_cosine = 0.5;

bool share_vertex(const SoupTriangle& a, const SoupTriangle& b) {
    return std::ranges::any_of(a.vertices, [&](std::uint32_t v) {
        return v == b.vertices[0] || v == b.vertices[1] || v == b.vertices[2];
    });
}

}  // namespace

std::vector<ThinWall> find_thin_walls(const TriangleSoup& soup, double thickness,
                                      const std::vector<MeetingPair>& meetings,
                                      const Workers& workers) {
    if (soup.triangles.empty() || !(thickness > 0.0)) return {};
    const TriangleTree tree(soup);
    const auto meet = [&](std::uint32_t a, std::uint32_t b) {
        const Pair sought{std::min(a, b), std::max(a, b)};
        const auto pair_of = [](const MeetingPair& m) { return Pair{m.a, m.b}; };
        const auto at = std::ranges::lower_bound(meetings, sought, {}, pair_of);
        return at != meetings.end() && pair_of(*at) == sought;
    };
    const auto look_behind = [&](std::uint32_t t) {
        const SoupTriangle& triangle = soup.triangles[t];
        const glm::dvec3 normal = glm::normalize(area_vector(soup, t));
        const glm::dvec3 centre =
            (soup.positions[triangle.vertices[0]] + soup.positions[triangle.vertices[1]] +
             soup.positions[triangle.vertices[2]]) /
            3.0;
        ThinWall wall{t, t, std::numeric_limits<double>::infinity()};
        for (const std::uint32_t other : tree.met_by(centre, centre - thickness * normal)) {
            if (other == t || share_vertex(triangle, soup.triangles[other]) || meet(t, other))
                continue;
            const glm::dvec3 across = glm::normalize(area_vector(soup, other));
            const double cosine = glm::dot(across, normal);
            if (std::abs(cosine) < least_cosine) continue;
            const glm::dvec3& corner = soup.positions[soup.triangles[other].vertices[0]];
            const double distance = glm::dot(across, centre - corner) / cosine;
            if (distance < wall.thickness || (distance == wall.thickness && other < wall.behind)) {
                wall.behind = other;
                wall.thickness = distance;
            }
        }
        return wall;
    };
    std::vector<std::vector<ThinWall>> found(workers.count());
    workers.for_ranges(soup.triangles.size(), 512, [&](std::size_t begin, std::size_t end, int w) {
        for (std::size_t t = begin; t < end; ++t)
            if (const ThinWall wall = look_behind(static_cast<std::uint32_t>(t));
                wall.behind != wall.triangle)
                found[w].push_back(wall);
    });
    std::vector<ThinWall> walls;
    for (const auto& part : found) walls.insert(walls.end(), part.begin(), part.end());
    std::ranges::sort(walls, {}, &ThinWall::triangle);
    return walls;
}

}  // namespace transillum
