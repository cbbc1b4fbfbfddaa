#include <transillum/repair/triangle_soup.h>
#include <transillum/scene/used_positions.h>

#include "repair/exact/predicates.h"
#include "repair/position_hash.h"
#include "repair/triangulate.h"

#include <glm/geometric.hpp>

#include <unordered_map>

namespace transillum {

namespace {

/// Merges; returns the new index of every old position.
std::vector<std::uint32_t> weld(const Scene& scene, TriangleSoup& soup, SoupCounts& counts) {
    const std::vector<bool> used = used_positions(scene);
    std::unordered_map<glm::dvec3, std::uint32_t, PositionHash> index;
    std::vector<std::uint32_t> renumbered(scene.positions.size());
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        if (!used[i]) continue;
        ++counts.vertices;
        const glm::dvec3 p = scene.positions[i] + 0.0;  // -0 is at the place of 0
        const auto [at, is_new] =
            index.try_emplace(p, static_cast<std::uint32_t>(soup.positions.size()));
        if (is_new) soup.positions.push_back(p);
        renumbered[i] = at->second;
    }
    counts.welded = counts.vertices - soup.positions.size();
    return renumbered;
}

void add_polygon(const Scene& scene, std::uint32_t number,
                 const std::vector<std::uint32_t>& renumbered, TriangleSoup& soup,
                 SoupCounts& counts) {
    const Polygon& polygon = scene.polygons[number];
    std::vector<glm::dvec3> outline;
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
        vertices.push_back(renumbered[scene.corners[polygon.first_corner + c]]);
        outline.push_back(soup.positions[vertices.back()]);
    }
    const auto triangles = triangulate_polygon(outline);
    if (triangles.empty()) ++counts.without_area;
    for (const auto& corner : triangles) {
        soup.triangles.push_back(
            {{vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]}, number});
        if (scene.uvs.empty()) continue;
        std::array<glm::vec2, 3>& uvs = soup.uvs.emplace_back();
        for (int i = 0; i < 3; ++i) uvs[i] = scene.uvs[polygon.first_corner + corner[i]];
    }
}

}  // namespace

TriangleSoup make_soup(const Scene& scene, SoupCounts* counts) {
    SoupCounts met;
    TriangleSoup soup;
    const std::vector<std::uint32_t> renumbered = weld(scene, soup, met);
    for (std::uint32_t i = 0; i < scene.polygons.size(); ++i)
        add_polygon(scene, i, renumbered, soup, met);
    if (counts) *counts = met;
    return soup;
}

glm::dvec3 area_vector(const TriangleSoup& soup, std::uint32_t triangle) {
    const auto& v = soup.triangles[triangle].vertices;
    const glm::dvec3& a = soup.positions[v[0]];
    return glm::cross(soup.positions[v[1]] - a, soup.positions[v[2]] - a);
}

bool has_area(const TriangleSoup& soup, std::uint32_t triangle) {
    const auto& v = soup.triangles[triangle].vertices;
    return area_vector(soup, triangle) != glm::dvec3(0.0) &&
           !are_collinear(soup.positions[v[0]], soup.positions[v[1]], soup.positions[v[2]]);
}

double diagonal_of(const TriangleSoup& soup) {
    if (soup.positions.empty()) return 0.0;
    glm::dvec3 low = soup.positions.front(), high = low;
    for (const glm::dvec3& p : soup.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::length(high - low);
}

}  // namespace transillum
