#include "repair/triangulate.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <glm/geometric.hpp>

#include <map>
#include <utility>

namespace transillum {

namespace {

constexpr std::uint32_t made_by_crossing = 0xffffffffu;

struct VertexInfo {
    std::uint32_t corner = made_by_crossing;
};

struct FaceInfo {
    int depth = -1;  ///< outline edges crossed from outside; -1 while unknown
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
// Outlines that cross themselves get the crossing as a new vertex.
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using Vertex = Triangulation::Vertex_handle;

glm::dvec3 area_vector(std::span<const glm::dvec3> outline) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        sum += glm::cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
    return sum;
}

std::vector<std::array<std::uint32_t, 3>> fan_of(std::size_t corners) {
    std::vector<std::array<std::uint32_t, 3>> fan;
    for (std::uint32_t i = 1; i + 1 < corners; ++i) fan.push_back({0, i, i + 1});
    return fan;
}

/// Drops the coordinate along which the polygon faces most, keeping its turning sense.
Kernel::Point_2 project(const glm::dvec3& p, const glm::dvec3& normal) {
    const glm::dvec3 a = glm::abs(normal);
    if (a.z >= a.x && a.z >= a.y)
        return normal.z > 0 ? Kernel::Point_2(p.x, p.y) : Kernel::Point_2(p.y, p.x);
    if (a.x >= a.y) return normal.x > 0 ? Kernel::Point_2(p.y, p.z) : Kernel::Point_2(p.z, p.y);
    return normal.y > 0 ? Kernel::Point_2(p.z, p.x) : Kernel::Point_2(p.x, p.z);
}

void insert_outline(Triangulation& t, std::span<const glm::dvec3> outline,
                    const glm::dvec3& normal) {
    std::vector<Vertex> vertices;
    for (std::uint32_t i = 0; i < outline.size(); ++i) {
        const std::size_t before = t.number_of_vertices();
        const Vertex v = t.insert(project(outline[i], normal));
        if (t.number_of_vertices() > before) v->info().corner = i;
        vertices.push_back(v);
    }
    // A seam is walked both ways and bounds nothing: only edges met an odd number of times do.
    std::map<std::pair<Vertex, Vertex>, bool> odd;
    std::vector<std::pair<Vertex, Vertex>> edges;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vertex a = vertices[i];
        const Vertex b = vertices[(i + 1) % vertices.size()];
        if (a == b) continue;
        edges.push_back(std::minmax(a, b));
        odd[edges.back()] ^= true;
    }
    // In the outline's order: handles compare by address, which would choose between equal
    // diagonals.
    for (const auto& edge : edges)
        if (odd[edge]) t.insert_constraint(edge.first, edge.second);
}

void mark_depths(Triangulation& t) {
    std::vector<Triangulation::Face_handle> border{t.infinite_face()};
    border.front()->info().depth = 0;
    for (int depth = 0; !border.empty(); ++depth) {
        std::vector<Triangulation::Face_handle> inside = std::move(border), next;
        while (!inside.empty()) {
            const auto face = inside.back();
            inside.pop_back();
            if (face->info().depth != -1 && face->info().depth != depth) continue;
            face->info().depth = depth;
            for (int i = 0; i < 3; ++i) {
                const auto neighbour = face->neighbor(i);
                if (neighbour->info().depth != -1) continue;
                if (face->is_constrained(i)) {
                    next.push_back(neighbour);
                } else {
                    neighbour->info().depth = depth;
                    inside.push_back(neighbour);
                }
            }
        }
        border = std::move(next);
    }
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(std::span<const glm::dvec3> outline) {
    if (outline.size() == 3) return fan_of(3);
    const glm::dvec3 normal = area_vector(outline);
    if (normal == glm::dvec3(0.0)) return {};
    Triangulation t;
    insert_outline(t, outline, normal);
    if (t.dimension() < 2) return {};
    for (const auto vertex : t.finite_vertex_handles())
        if (vertex->info().corner == made_by_crossing) return fan_of(outline.size());
    mark_depths(t);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto face : t.finite_face_handles()) {
        if (face->info().depth % 2 == 0) continue;
        std::array<std::uint32_t, 3> corner{};
        for (int i = 0; i < 3; ++i) corner[i] = face->vertex(i)->info().corner;
        triangles.push_back(corner);
    }
    return triangles;
}

}  // namespace transillum
