#include "render/vertex_grid.h"

#include <transillum/base/sampling.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace transillum {

namespace {

constexpr std::uint32_t unknown = 0xffffffffu;
constexpr std::uint32_t edge_units = 1u << max_subdivision_level;

/// An edge of a root, named by the fans at its ends: no other smooth edge joins these two.
struct EdgeKey {
    std::uint32_t low, high;
    bool operator==(const EdgeKey&) const = default;
};
/// A place on an edge, in units of 2^-max_subdivision_level from its lower fan.
struct PlaceKey {
    EdgeKey edge;
    std::uint32_t place;
    bool operator==(const PlaceKey&) const = default;
};
struct KeyHash {
    std::size_t operator()(const EdgeKey& k) const {
        return hash_bits((static_cast<std::uint64_t>(k.low) << 32) | k.high);
    }
    std::size_t operator()(const PlaceKey& k) const { return hash_bits((*this)(k.edge) ^ k.place); }
};

class GridBuilder {
public:
    GridBuilder(const SurfaceMesh& mesh, const PatchHierarchy& patches)
        : mesh_(mesh), patches_(patches) {
        fan_vertices_.assign(mesh.fan_count, unknown);
        for (std::uint32_t root = 0; root < mesh.triangles.size(); ++root) find_coarsest(root);
    }

    VertexGrid build() {
        grid_.leaf_vertices.resize(patches_.leaf_count);
        grid_.leaf_centres.resize(patches_.leaf_count);
        grid_.leaf_normals.resize(patches_.leaf_count);
        for (std::uint32_t root = 0; root < mesh_.triangles.size(); ++root) number_root(root);
        for (const auto& [key, vertex] : hanging_) hang(key, vertex);
        collect_touching();
        return std::move(grid_);
    }

private:
    static constexpr std::array<std::pair<int, int>, 3> edge_ends{{{0, 1}, {1, 2}, {0, 2}}};

    [[nodiscard]] EdgeKey edge_of(std::uint32_t root, int edge) const {
        const auto [a, b] = edge_ends[edge];
        const auto& fans = mesh_.triangles[root].fans;
        return {std::min(fans[a], fans[b]), std::max(fans[a], fans[b])};
    }

    void find_coarsest(std::uint32_t root) {
        for (int edge = 0; edge < 3; ++edge) {
            const int level = patches_.roots[root].level;
            int& coarsest = coarsest_.try_emplace(edge_of(root, edge), level).first->second;
            coarsest = std::min(coarsest, level);
        }
    }

    std::uint32_t add(const glm::dvec3& position) {
        grid_.positions.push_back(position);
        return static_cast<std::uint32_t>(grid_.positions.size() - 1);
    }

    void number_root(std::uint32_t root) {
        const RootPatches& r = patches_.roots[root];
        const int n = 1 << r.level;
        std::vector<std::uint32_t> numbers(static_cast<std::size_t>(n + 1) * (n + 1), unknown);
        for (std::uint32_t leaf = r.first_leaf; leaf < r.first_leaf + (1u << (2 * r.level));
             ++leaf) {
            const auto corners = leaf_corners(patches_, leaf);
            for (int c = 0; c < 3; ++c) {
                std::uint32_t& number =
                    numbers[static_cast<std::size_t>(corners[c].y) * (n + 1) + corners[c].x];
                if (number == unknown) number = vertex_at(root, corners[c]);
                grid_.leaf_vertices[leaf][c] = number;
                grid_.leaf_centres[leaf] += grid_.positions[number] / 3.0;
            }
            grid_.leaf_normals[leaf] = normal_of(mesh_, root);
        }
    }

    std::uint32_t vertex_at(std::uint32_t root, glm::ivec2 b) {
        const int n = 1 << patches_.roots[root].level;
        const auto& fans = mesh_.triangles[root].fans;
        if (b == glm::ivec2(0, 0)) return corner(fans[0], root, b);
        if (b == glm::ivec2(n, 0)) return corner(fans[1], root, b);
        if (b == glm::ivec2(0, n)) return corner(fans[2], root, b);
        if (b.y == 0) return on_edge(root, 0, b.x, b);
        if (b.x + b.y == n) return on_edge(root, 1, b.y, b);
        if (b.x == 0) return on_edge(root, 2, b.y, b);
        return add(point_of_root(mesh_, root, b, patches_.roots[root].level));
    }

    std::uint32_t corner(std::uint32_t fan, std::uint32_t root, glm::ivec2 b) {
        if (fan_vertices_[fan] == unknown)
            fan_vertices_[fan] = add(point_of_root(mesh_, root, b, patches_.roots[root].level));
        return fan_vertices_[fan];
    }

    std::uint32_t on_edge(std::uint32_t root, int edge, int steps, glm::ivec2 b) {
        const int level = patches_.roots[root].level;
        const EdgeKey key = edge_of(root, edge);
        std::uint32_t place = static_cast<std::uint32_t>(steps) << (max_subdivision_level - level);
        if (mesh_.triangles[root].fans[edge_ends[edge].first] != key.low)
            place = edge_units - place;
        const auto [found, added] = edge_vertices_.try_emplace({key, place}, 0);
        if (added) {
            found->second = add(point_of_root(mesh_, root, b, level));
            if (place % coarse_step(key) != 0) hanging_.push_back({{key, place}, found->second});
        }
        return found->second;
    }

    [[nodiscard]] std::uint32_t coarse_step(const EdgeKey& key) const {
        return edge_units >> coarsest_.at(key);
    }
    [[nodiscard]] std::uint32_t known_vertex(const PlaceKey& key) const {
        if (key.place == 0) return fan_vertices_[key.edge.low];
        if (key.place == edge_units) return fan_vertices_[key.edge.high];
        return edge_vertices_.at(key);
    }

    void hang(const PlaceKey& key, std::uint32_t vertex) {
        const std::uint32_t step = coarse_step(key.edge), rest = key.place % step;
        grid_.hanging.push_back({vertex, known_vertex({key.edge, key.place - rest}),
                                 known_vertex({key.edge, key.place - rest + step}),
                                 static_cast<float>(rest) / static_cast<float>(step)});
    }

    void collect_touching() {
        grid_.first_touching.assign(grid_.vertex_count() + 1, 0);
        for (const auto& vertices : grid_.leaf_vertices)
            for (const std::uint32_t v : vertices) ++grid_.first_touching[v + 1];
        for (std::size_t v = 0; v < grid_.vertex_count(); ++v)
            grid_.first_touching[v + 1] += grid_.first_touching[v];
        grid_.touching.resize(3 * grid_.leaf_vertices.size());
        std::vector<std::uint32_t> next(grid_.first_touching.begin(),
                                        grid_.first_touching.end() - 1);
        for (std::uint32_t leaf = 0; leaf < grid_.leaf_vertices.size(); ++leaf)
            for (const std::uint32_t v : grid_.leaf_vertices[leaf])
                grid_.touching[next[v]++] = leaf;
    }

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    VertexGrid grid_;
    std::vector<std::uint32_t> fan_vertices_;
    std::unordered_map<EdgeKey, int, KeyHash> coarsest_;
    std::unordered_map<PlaceKey, std::uint32_t, KeyHash> edge_vertices_;
    std::vector<std::pair<PlaceKey, std::uint32_t>> hanging_;
};

}  // namespace

VertexGrid build_vertex_grid(const SurfaceMesh& mesh, const PatchHierarchy& patches) {
    return GridBuilder(mesh, patches).build();
}

}  // namespace transillum
