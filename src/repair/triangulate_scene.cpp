#include <transillum/base/error.h>
#include <transillum/repair/triangulate_scene.h>

#include "repair/triangulate.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace transillum {

namespace {

using Corners = std::vector<std::array<std::uint32_t, 3>>;

Corners triangles_of(const Scene& scene, const Polygon& polygon) {
    if (polygon.corner_count == 3) return {{0, 1, 2}};
    std::vector<glm::dvec3> outline;
    for (std::uint32_t c = 0; c < polygon.corner_count; ++c)
        outline.push_back(scene.positions[scene.corners[polygon.first_corner + c]]);
    return triangulate_polygon(outline);
}

}  // namespace

TriangulationReport triangulate_scene(Scene& scene) {
    TriangulationReport report;
    if (std::ranges::all_of(scene.polygons, [](const Polygon& p) { return p.corner_count == 3; }))
        return report;
    std::vector<Polygon> polygons;
    std::vector<std::uint32_t> corners;
    std::vector<glm::vec2> uvs;
    for (const Polygon& polygon : scene.polygons) {
        const Corners triangles = triangles_of(scene, polygon);
        report.polygons += polygon.corner_count > 3;
        report.without_area += triangles.empty();
        if (corners.size() + 3 * triangles.size() > std::numeric_limits<std::uint32_t>::max())
            throw InputError(scene.path,
                             "more than 4294967295 corners of triangles; accepted: "
                             "fewer");
        for (const auto& triangle : triangles) {
            Polygon& made = polygons.emplace_back(polygon);
            made.first_corner = static_cast<std::uint32_t>(corners.size());
            made.corner_count = 3;
            for (const std::uint32_t c : triangle) {
                corners.push_back(scene.corners[polygon.first_corner + c]);
                if (!scene.uvs.empty()) uvs.push_back(scene.uvs[polygon.first_corner + c]);
            }
        }
    }
    scene.polygons = std::move(polygons);
    scene.corners = std::move(corners);
    scene.uvs = std::move(uvs);
    return report;
}

}  // namespace transillum
