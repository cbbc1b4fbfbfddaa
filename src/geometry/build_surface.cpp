#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/geometry/surface_mesh.h>

#include "geometry/find_fans.h"
#include "geometry/predicates.h"
#include "geometry/triangulate.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <unordered_map>

namespace transillum {

namespace {

constexpr int grid_bits = 40;

struct PositionHash {
    std::size_t operator()(const glm::dvec3& p) const {
        const auto bits = [](double x) { return hash_bits(std::bit_cast<std::uint64_t>(x)); };
        return hash_bits(bits(p.x) ^ (bits(p.y) << 1) ^ (bits(p.z) << 2));
    }
};

/// Vertices without a polygon would only widen the grid and the window.
std::vector<bool> used_positions(const Scene& scene) {
    std::vector<bool> used(scene.positions.size());
    for (const Polygon& polygon : scene.polygons)
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c)
            used[scene.corners[polygon.first_corner + c]] = true;
    return used;
}

int grid_exponent(const Scene& scene, const std::vector<bool>& used) {
    double largest = 0.0;
    for (const glm::dvec3& p : scene.positions) {
        if (!used[static_cast<std::size_t>(&p - scene.positions.data())]) continue;
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            throw InputError(
                scene.path,
                "vertex " + std::to_string(&p - scene.positions.data()) +
                    " has a coordinate that is no finite number; accepted: finite ones");
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    if (largest == 0.0) return -grid_bits;
    int exponent = 0;
    std::frexp(largest, &exponent);  // largest < 2^exponent
    return exponent - grid_bits;
}

glm::dvec3 snap(const glm::dvec3& p, int exponent) {
    const auto round = [&](double x) {
        return std::ldexp(std::nearbyint(std::ldexp(x, -exponent)), exponent) + 0.0;
    };
    return {round(p.x), round(p.y), round(p.z)};
}

/// Snaps and merges; returns the new index of every old position.
std::vector<std::uint32_t> weld(const Scene& scene, SurfaceMesh& mesh, SurfaceReport& report) {
    const std::vector<glm::dvec3>& positions = scene.positions;
    const std::vector<bool> used = used_positions(scene);
    mesh.grid.exponent = grid_exponent(scene, used);
    std::unordered_map<glm::dvec3, std::uint32_t, PositionHash> index;
    std::vector<std::uint32_t> renumbered;
    renumbered.reserve(positions.size());
    std::size_t met = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (!used[i]) {
            renumbered.push_back(0);
            continue;
        }
        ++met;
        const glm::dvec3& p = positions[i];
        const glm::dvec3 s = snap(p, mesh.grid.exponent);
        mesh.grid.largest_move = std::max(mesh.grid.largest_move, glm::length(s - p));
        const auto [at, is_new] =
            index.try_emplace(s, static_cast<std::uint32_t>(mesh.positions.size()));
        if (is_new) mesh.positions.push_back(s);
        renumbered.push_back(at->second);
    }
    report.welded = met - mesh.positions.size();
    return renumbered;
}

/// The three vertices turned so that the smallest comes first: equal for faces that cover each
/// other alike.
std::array<std::uint32_t, 3> turned(std::array<std::uint32_t, 3> v) {
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    return v;
}

/// On one line, or so nearly that the cross product rounds to nothing and there is no normal.
bool has_no_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return are_collinear(a, b, c) || glm::cross(b - a, c - a) == glm::dvec3(0.0);
}

void add_polygon(const Scene& scene, const Polygon& polygon,
                 const std::vector<std::uint32_t>& renumbered, SurfaceMesh& mesh,
                 std::set<std::array<std::uint32_t, 3>>& seen, SurfaceReport& report) {
    std::vector<glm::dvec3> outline;
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
        vertices.push_back(renumbered[scene.corners[polygon.first_corner + c]]);
        outline.push_back(mesh.positions[vertices.back()]);
    }
    const auto triangles = triangulate_polygon(outline);
    if (triangles.empty()) ++report.degenerate;
    for (const auto& corner : triangles) {
        RootTriangle t{.material = polygon.material,
                       .object = polygon.object,
                       .source_face = polygon.source_face};
        for (int i = 0; i < 3; ++i) t.vertices[i] = vertices[corner[i]];
        if (has_no_area(outline[corner[0]], outline[corner[1]], outline[corner[2]])) {
            ++report.degenerate;
        } else if (!seen.insert(turned(t.vertices)).second) {
            ++report.duplicate;
        } else {
            mesh.triangles.push_back(t);
            if (scene.uvs.empty()) continue;
            for (const std::uint32_t c : corner)
                mesh.uvs.push_back(scene.uvs[polygon.first_corner + c]);
        }
    }
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
    const std::vector<std::uint32_t> renumbered = weld(scene, mesh, counts);
    std::set<std::array<std::uint32_t, 3>> seen;
    for (const Polygon& polygon : scene.polygons)
        add_polygon(scene, polygon, renumbered, mesh, seen, counts);
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
