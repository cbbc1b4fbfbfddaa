#include <transillum/base/error.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/repair/triangle_soup.h>

#include "geometry/find_fans.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <set>

namespace transillum {

namespace {

/// The three vertices turned so that the smallest comes first: equal for faces that cover each
/// other alike.
std::array<std::uint32_t, 3> turned(std::array<std::uint32_t, 3> v) {
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    return v;
}

void add_triangle(const TriangleSoup& soup, std::uint32_t number, const Scene& scene,
                  std::set<std::array<std::uint32_t, 3>>& seen, SurfaceMesh& mesh,
                  SurfaceReport& report) {
    const SoupTriangle& triangle = soup.triangles[number];
    const auto& v = triangle.vertices;
    if (!has_area(soup, number)) {
        ++report.degenerate;
        return;
    }
    if (!seen.insert(turned(v)).second) {
        ++report.duplicate;
        return;
    }
    const Polygon& polygon = scene.polygons[triangle.polygon];
    mesh.triangles.push_back({.vertices = v,
                              .material = polygon.material,
                              .object = polygon.object,
                              .source_face = polygon.source_face});
    if (!soup.uvs.empty())
        mesh.uvs.insert(mesh.uvs.end(), soup.uvs[number].begin(), soup.uvs[number].end());
}

/// Drops vertices whose triangles were all left out.
void drop_unused_vertices(SurfaceMesh& mesh) {
    constexpr std::uint32_t unused = 0xffffffffu;
    std::vector<std::uint32_t> renumbered(mesh.positions.size(), unused);
    std::vector<glm::dvec3> kept;
    for (RootTriangle& t : mesh.triangles)
        for (std::uint32_t& v : t.vertices) {
            if (renumbered[v] == unused) {
                renumbered[v] = static_cast<std::uint32_t>(kept.size());
                kept.push_back(mesh.positions[v]);
            }
            v = renumbered[v];
        }
    mesh.positions = std::move(kept);
}

void tell(const Scene& scene, const SurfaceReport& report, Monitor& monitor) {
    if (report.degenerate > 0)
        monitor.note(scene.path + ": left out " + std::to_string(report.degenerate) +
                     " triangles without area");
    if (report.duplicate > 0)
        monitor.note(scene.path + ": left out " + std::to_string(report.duplicate) +
                     " triangles that repeat an earlier one");
}

}  // namespace

SurfaceMesh build_surface(const Scene& scene, const SurfaceOptions& options, Monitor& monitor,
                          SurfaceReport* report) {
    SurfaceReport counts;
    counts.polygons = scene.polygons.size();
    SurfaceMesh mesh;
    mesh.materials = scene.materials;
    mesh.textures = scene.textures;
    mesh.objects = scene.objects;
    Scene snapped = scene;
    mesh.grid = snap_scene(snapped, Rounding::dyadic);
    SoupCounts met;
    TriangleSoup soup = make_soup(snapped, &met);
    counts.welded = met.welded;
    counts.degenerate = met.without_area;
    std::set<std::array<std::uint32_t, 3>> seen;
    for (std::uint32_t i = 0; i < soup.triangles.size(); ++i)
        add_triangle(soup, i, scene, seen, mesh, counts);
    mesh.positions = std::move(soup.positions);
    counts.triangles = mesh.triangles.size();
    if (mesh.triangles.empty())
        throw InputError(scene.path, "no triangle with an area; accepted: at least one");
    drop_unused_vertices(mesh);
    find_fans(mesh, options.crease_angle, counts);
    tell(scene, counts, monitor);
    if (report) *report = counts;
    return mesh;
}

glm::dvec3 normal_of(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const auto& v = mesh.triangles[triangle].vertices;
    const glm::dvec3& a = mesh.positions[v[0]];
    return glm::normalize(glm::cross(mesh.positions[v[1]] - a, mesh.positions[v[2]] - a));
}

double area_of(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const auto& v = mesh.triangles[triangle].vertices;
    const glm::dvec3& a = mesh.positions[v[0]];
    return 0.5 * glm::length(glm::cross(mesh.positions[v[1]] - a, mesh.positions[v[2]] - a));
}

}  // namespace transillum
