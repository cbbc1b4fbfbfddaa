/// Root triangles as shading needs them.
#pragma once

#include <transillum/geometry/surface_mesh.h>
#include <transillum/visibility/ray_tracer.h>

#include <glm/geometric.hpp>

#include <vector>

namespace transillum {

struct Facet {
    glm::dvec3 origin, edge1, edge2;  ///< first vertex; from it to the second and third
    glm::dvec3 normal;                ///< unit, of the front
    double area;

    [[nodiscard]] glm::dvec3 point(double b1, double b2) const {
        return origin + b1 * edge1 + b2 * edge2;
    }
    [[nodiscard]] glm::dvec3 side_normal(bool back) const { return back ? -normal : normal; }
};

[[nodiscard]] inline std::vector<Facet> facets_of(const SurfaceMesh& mesh) {
    std::vector<Facet> facets;
    facets.reserve(mesh.triangles.size());
    for (const RootTriangle& t : mesh.triangles) {
        const glm::dvec3& origin = mesh.positions[t.vertices[0]];
        const glm::dvec3 edge1 = mesh.positions[t.vertices[1]] - origin;
        const glm::dvec3 edge2 = mesh.positions[t.vertices[2]] - origin;
        const glm::dvec3 across = glm::cross(edge1, edge2);
        const double twice_area = glm::length(across);
        facets.push_back({origin, edge1, edge2, across / twice_area, 0.5 * twice_area});
    }
    return facets;
}

}  // namespace transillum
