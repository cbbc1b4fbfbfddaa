#include "transport/coplanar_groups.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace transillum {

namespace {

/// Sine of the angle between normals that rounding explains: an angle, so it has no scale.
constexpr double same_plane = 1e-6;

struct Edge {
    std::uint32_t low, high, root;
    [[nodiscard]] bool joins(const Edge& e) const { return low == e.low && high == e.high; }
};

std::vector<Edge> sorted_edges(const SurfaceMesh& mesh) {
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r) {
        const auto& v = mesh.triangles[r].vertices;
        for (int i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax({v[i], v[(i + 1) % 3]});
            edges.push_back({low, high, r});
        }
    }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::tuple(e.low, e.high, e.root); });
    return edges;
}

bool are_coplanar(const SurfaceMesh& mesh, std::uint32_t a, std::uint32_t b) {
    const glm::dvec3 n = normal_of(mesh, a), m = normal_of(mesh, b);
    return glm::dot(n, m) > 0.0 && glm::length(glm::cross(n, m)) < same_plane;
}

}  // namespace

std::vector<std::uint32_t> coplanar_groups(const SurfaceMesh& mesh) {
    std::vector<std::uint32_t> group(mesh.triangles.size());
    std::iota(group.begin(), group.end(), 0u);
    const auto first_of = [&](std::uint32_t r) {
        while (group[r] != r) r = group[r] = group[group[r]];
        return r;
    };
    const std::vector<Edge> edges = sorted_edges(mesh);
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t k = i + 1; k < edges.size() && edges[k].joins(edges[i]); ++k)
            if (are_coplanar(mesh, edges[i].root, edges[k].root)) {
                const auto [low, high] =
                    std::minmax({first_of(edges[i].root), first_of(edges[k].root)});
                group[high] = low;
            }
    for (std::uint32_t r = 0; r < group.size(); ++r) group[r] = first_of(r);
    return group;
}

}  // namespace transillum
