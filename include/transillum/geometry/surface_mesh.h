/// The triangles light travels between: welded, triangulated, every one traceable to its source.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/repair/snap_grid.h>
#include <transillum/scene/scene.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace transillum {

/// A root triangle; the front is where its vertices turn counter-clockwise.
struct RootTriangle {
    std::array<std::uint32_t, 3> vertices{};  ///< indices into SurfaceMesh::positions
    /// Shading fans of the corners: corners with the same fan number share a vertex and are joined
    /// by edges that are no crease and separate neither materials nor objects (style of Gouraud,
    /// paper §6).
    std::array<std::uint32_t, 3> fans{};
    std::uint32_t material = 0;
    std::uint32_t object = 0;
    std::uint32_t source_face = 0;
};

struct SurfaceMesh {
    std::vector<glm::dvec3> positions;
    std::vector<RootTriangle> triangles;
    std::vector<glm::vec2> uvs;  ///< three a triangle, or empty
    std::uint32_t fan_count = 0;
    std::vector<Material> materials;
    std::vector<std::shared_ptr<const Texture>> textures;
    std::vector<std::string> objects;
    SnapGrid grid;
};

struct SurfaceOptions {
    double crease_angle = 30.0;  ///< [degrees] between normals; sharper edges are not shaded across
};

/// Counts of what was left out or changed on the way from the soup.
struct SurfaceReport {
    std::uint64_t polygons = 0, triangles = 0;
    std::uint64_t degenerate = 0;  ///< triangles without area, dropped
    std::uint64_t duplicate =
        0;  ///< triangles on the same three vertices as an earlier one, wound alike, dropped
    std::uint64_t welded = 0;  ///< vertices merged with one at the same place
    std::uint64_t border_edges = 0, nonmanifold_edges = 0, crease_edges = 0;
};

/// Snaps, welds, triangulates (constrained Delaunay, so concave polygons and seams come out right),
/// and drops degenerate and duplicate triangles; finds the shading fans. Reports through the
/// monitor what it dropped. \throws InputError when no triangle is left.
[[nodiscard]] SurfaceMesh build_surface(const Scene& scene, const SurfaceOptions& options,
                                        Monitor& monitor, SurfaceReport* report = nullptr);

/// Unit normal of the front, and area, of a root triangle.
[[nodiscard]] glm::dvec3 normal_of(const SurfaceMesh& mesh, std::uint32_t triangle);
[[nodiscard]] double area_of(const SurfaceMesh& mesh, std::uint32_t triangle);

}  // namespace transillum
