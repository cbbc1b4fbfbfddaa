#include "geometry/find_fans.h"

#include <transillum/base/disjoint_sets.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    FaceAttributes(OpenMesh::Attributes::None);
    VertexAttributes(OpenMesh::Attributes::None);
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

/// Would the half-edge structure have to hold a third face at an edge, or two fans at a vertex?
bool is_complex(const HalfEdgeMesh& mesh, const std::array<OpenMesh::VertexHandle, 3>& v) {
    for (int i = 0; i < 3; ++i) {
        if (!mesh.is_boundary(v[i])) return true;
        const auto edge = mesh.find_halfedge(v[i], v[(i + 1) % 3]);
        if (edge.is_valid() && !mesh.is_boundary(edge)) return true;
    }
    return false;
}

/// OpenMesh says on its own error stream which faces it cannot link; they are dealt with here.
class QuietOpenMesh {
public:
    QuietOpenMesh() { omerr().disable(); }
    ~QuietOpenMesh() { omerr().enable(); }
    QuietOpenMesh(const QuietOpenMesh&) = delete;
    QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;
};

/// Face i of the half-edge mesh is triangle i; a triangle that would make it non-manifold gets
/// vertices of its own.
HalfEdgeMesh make_half_edges(const SurfaceMesh& mesh) {
    const QuietOpenMesh quiet;
    HalfEdgeMesh half_edges;
    const auto add = [&](std::uint32_t vertex) {
        const glm::dvec3& p = mesh.positions[vertex];
        return half_edges.add_vertex({p.x, p.y, p.z});
    };
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) add(i);
    for (const RootTriangle& t : mesh.triangles) {
        std::array<OpenMesh::VertexHandle, 3> v;
        for (int i = 0; i < 3; ++i) v[i] = OpenMesh::VertexHandle(static_cast<int>(t.vertices[i]));
        if (!is_complex(half_edges, v) && half_edges.add_face(v[0], v[1], v[2]).is_valid())
            continue;
        for (int i = 0; i < 3; ++i) v[i] = add(t.vertices[i]);
        half_edges.add_face(v[0], v[1], v[2]);
    }
    return half_edges;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Edges of three or more triangles, sorted. Light may differ on all sides of them: a floor that
/// runs on under a wall.
std::vector<Edge> edges_of_many(const SurfaceMesh& mesh) {
    std::vector<Edge> all, many;
    for (const RootTriangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            all.push_back(std::minmax(t.vertices[i], t.vertices[(i + 1) % 3]));
    std::sort(all.begin(), all.end());
    for (std::size_t i = 2; i < all.size(); ++i)
        if (all[i] == all[i - 2] && (many.empty() || many.back() != all[i])) many.push_back(all[i]);
    return many;
}

std::uint32_t corner_at(const SurfaceMesh& mesh, std::uint32_t triangle, const glm::dvec3& p) {
    const RootTriangle& t = mesh.triangles[triangle];
    for (std::uint32_t i = 0; i < 2; ++i)
        if (mesh.positions[t.vertices[i]] == p) return 3 * triangle + i;
    return 3 * triangle + 2;
}

}  // namespace

void find_fans(SurfaceMesh& mesh, double crease_angle, SurfaceReport& report) {
    const HalfEdgeMesh half_edges = make_half_edges(mesh);
    const double least_cosine = std::cos(crease_angle * std::numbers::pi / 180.0);
    const std::vector<Edge> shared_by_many = edges_of_many(mesh);
    report.nonmanifold_edges = shared_by_many.size();
    DisjointSets sets(3 * mesh.triangles.size());
    for (const auto edge : half_edges.edges()) {
        const auto h = half_edges.halfedge_handle(edge, 0);
        if (half_edges.is_boundary(edge)) {
            ++report.border_edges;
            continue;
        }
        const auto f = static_cast<std::uint32_t>(half_edges.face_handle(h).idx());
        const auto g = static_cast<std::uint32_t>(
            half_edges.face_handle(half_edges.opposite_halfedge_handle(h)).idx());
        const RootTriangle& a = mesh.triangles[f];
        const RootTriangle& b = mesh.triangles[g];
        if (a.material != b.material || a.object != b.object) continue;
        if (glm::dot(normal_of(mesh, f), normal_of(mesh, g)) < least_cosine) {
            ++report.crease_edges;
            continue;
        }
        std::array<std::uint32_t, 2> at_f{}, at_g{};
        for (int end = 0; end < 2; ++end) {
            const auto v =
                end == 0 ? half_edges.from_vertex_handle(h) : half_edges.to_vertex_handle(h);
            const auto& p = half_edges.point(v);
            at_f[end] = corner_at(mesh, f, {p[0], p[1], p[2]});
            at_g[end] = corner_at(mesh, g, {p[0], p[1], p[2]});
        }
        const Edge ends = std::minmax(a.vertices[at_f[0] % 3], a.vertices[at_f[1] % 3]);
        if (std::binary_search(shared_by_many.begin(), shared_by_many.end(), ends)) continue;
        for (int end = 0; end < 2; ++end) sets.join(at_f[end], at_g[end]);
    }
    std::vector<std::uint32_t> fan_of_set(3 * mesh.triangles.size(), 0xffffffffu);
    mesh.fan_count = 0;
    for (std::uint32_t c = 0; c < fan_of_set.size(); ++c) {
        std::uint32_t& fan = fan_of_set[sets.find(c)];
        if (fan == 0xffffffffu) fan = mesh.fan_count++;
        mesh.triangles[c / 3].fans[c % 3] = fan;
    }
}

}  // namespace transillum
