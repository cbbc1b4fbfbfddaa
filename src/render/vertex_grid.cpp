#include "render/vertex_grid.h"

#include <transillum/base/sampling.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace transillum {

namespace {

constexpr std::uint32_t unknown = 0xffffffffu;
/// Ends and middles of all edges of leaves along a root's edge lie at whole units.
constexpr std::uint32_t edge_units = 2u << max_subdivision_level;

/// An edge of a root, named by the fans at its ends: no other smooth edge joins these two.
struct EdgeKey {
    std::uint32_t low, high;
    bool operator==(const EdgeKey&) const = default;
};
/// A place on an edge, in units of 1 / edge_units from its lower fan.
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

/// A vertex within the edge of a leaf.
struct Candidate {
    int level;  ///< of that leaf
    VertexGrid::Hanging hanging;
};

class GridBuilder {
public:
    GridBuilder(const SurfaceMesh& mesh, const PatchHierarchy& patches)
        : mesh_(mesh), patches_(patches), fan_vertices_(mesh.fan_count, unknown) {}

    VertexGrid build() {
        grid_.leaf_vertices.resize(patches_.leaf_count);
        grid_.leaf_centres.resize(patches_.leaf_count);
        grid_.leaf_normals.resize(patches_.leaf_count);
        for (std::uint32_t root = 0; root < mesh_.triangles.size(); ++root) {
            number_root(root);
            if (patches_.roots[root].mixed != RootPatches::uniform) hang_within(root);
        }
        for (const auto& [place, vertex] : edge_vertices_in_order_) hang_on_edge(place, vertex);
        collect_hanging();
        collect_touching();
        return std::move(grid_);
    }

private:
    /// First to second corner, second to third, first to third.
    static constexpr std::array<std::pair<int, int>, 3> edge_ends{{{0, 1}, {1, 2}, {0, 2}}};

    [[nodiscard]] EdgeKey edge_of(std::uint32_t root, int edge) const {
        const auto [a, b] = edge_ends[edge];
        const auto& fans = mesh_.triangles[root].fans;
        return {std::min(fans[a], fans[b]), std::max(fans[a], fans[b])};
    }

    /// The edge of the root that a point lies on, in units of 2^-level, and at which step.
    struct OnEdge {
        int edge, step;
    };
    [[nodiscard]] static std::optional<OnEdge> find_edge(glm::ivec2 b, int level) {
        if (b.y == 0) return OnEdge{0, b.x};
        if (b.x + b.y == 1 << level) return OnEdge{1, b.y};
        if (b.x == 0) return OnEdge{2, b.y};
        return std::nullopt;
    }

    [[nodiscard]] PlaceKey place_of(std::uint32_t root, const OnEdge& at, int level) const {
        const EdgeKey key = edge_of(root, at.edge);
        const std::uint32_t place = static_cast<std::uint32_t>(at.step) * (edge_units >> level);
        const bool forwards = mesh_.triangles[root].fans[edge_ends[at.edge].first] == key.low;
        return {key, forwards ? place : edge_units - place};
    }

    std::uint32_t add(const glm::dvec3& position) {
        grid_.positions.push_back(position);
        return static_cast<std::uint32_t>(grid_.positions.size() - 1);
    }

    void number_root(std::uint32_t root) {
        const RootPatches& r = patches_.roots[root];
        lattice_.assign(lattice_size(r.level), unknown);
        for (std::uint32_t leaf = r.first_leaf; leaf < r.first_leaf + patches_.leaves_of(root);
             ++leaf) {
            const auto [corners, level] = leaf_corners(patches_, leaf);
            for (int c = 0; c < 3; ++c) {
                std::uint32_t& number =
                    lattice_[lattice_number(r.level, corners[c] * (1 << (r.level - level)))];
                if (number == unknown) number = vertex_at(root, corners[c], level);
                grid_.leaf_vertices[leaf][c] = number;
                grid_.leaf_centres[leaf] += grid_.positions[number] / 3.0;
                note_edge(root, corners[c] + corners[(c + 1) % 3], level + 1);
            }
            grid_.leaf_normals[leaf] = normal_of(mesh_, root);
        }
    }

    /// An edge of a leaf, by its middle, if it lies on the root's.
    void note_edge(std::uint32_t root, glm::ivec2 middle, int level) {
        if (const auto at = find_edge(middle, level)) middles_.insert(place_of(root, *at, level));
    }

    std::uint32_t vertex_at(std::uint32_t root, glm::ivec2 b, int level) {
        const int n = 1 << level;
        const auto& fans = mesh_.triangles[root].fans;
        if (b == glm::ivec2(0, 0)) return corner(fans[0], root, b, level);
        if (b == glm::ivec2(n, 0)) return corner(fans[1], root, b, level);
        if (b == glm::ivec2(0, n)) return corner(fans[2], root, b, level);
        const auto at = find_edge(b, level);
        if (!at) return add(point_of_root(mesh_, root, b, level));
        const auto [found, added] = edge_vertices_.try_emplace(place_of(root, *at, level), 0);
        if (added) {
            found->second = add(point_of_root(mesh_, root, b, level));
            edge_vertices_in_order_.emplace_back(found->first, found->second);
        }
        return found->second;
    }

    std::uint32_t corner(std::uint32_t fan, std::uint32_t root, glm::ivec2 b, int level) {
        if (fan_vertices_[fan] == unknown)
            fan_vertices_[fan] = add(point_of_root(mesh_, root, b, level));
        return fan_vertices_[fan];
    }

    /// Vertices within the edges of the root just numbered.
    void hang_within(std::uint32_t root) {
        const RootPatches& r = patches_.roots[root];
        for (std::uint32_t leaf = r.first_leaf; leaf < r.first_leaf + patches_.leaves_of(root);
             ++leaf) {
            const auto [corners, level] = leaf_corners(patches_, leaf);
            const int steps = 1 << (r.level - level);
            for (int c = 0; c < 3; ++c) {
                const glm::ivec2 from = corners[c], to = corners[(c + 1) % 3];
                if (find_edge(from + to, level + 1)) continue;
                for (int step = 1; step < steps; ++step) {
                    const std::uint32_t vertex =
                        lattice_[lattice_number(r.level, from * steps + (to - from) * step)];
                    if (vertex == unknown) continue;
                    const auto& ends = grid_.leaf_vertices[leaf];
                    candidates_.push_back({level,
                                           {vertex, ends[c], ends[(c + 1) % 3],
                                            static_cast<float>(step) / static_cast<float>(steps)}});
                }
            }
        }
    }

    /// Within the longest edge of a leaf on either side.
    void hang_on_edge(const PlaceKey& key, std::uint32_t vertex) {
        for (int level = 0;; ++level) {
            const std::uint32_t length = edge_units >> level, rest = key.place % length;
            if (rest == 0) return;
            const std::uint32_t start = key.place - rest;
            if (!middles_.contains({key.edge, start + length / 2})) continue;
            candidates_.push_back(
                {level,
                 {vertex, known_vertex({key.edge, start}), known_vertex({key.edge, start + length}),
                  static_cast<float>(rest) / static_cast<float>(length)}});
            return;
        }
    }

    [[nodiscard]] std::uint32_t known_vertex(const PlaceKey& key) const {
        if (key.place == 0) return fan_vertices_[key.edge.low];
        if (key.place == edge_units) return fan_vertices_[key.edge.high];
        return edge_vertices_.at(key);
    }

    /// Edges that hold a vertex lie one within the other. An end of the longest hangs, if at all,
    /// on a longer one of another line: of a smaller level.
    void collect_hanging() {
        std::ranges::stable_sort(candidates_, {}, &Candidate::level);
        std::vector<bool> hangs(grid_.vertex_count());
        for (const Candidate& c : candidates_) {
            if (hangs[c.hanging.vertex]) continue;
            hangs[c.hanging.vertex] = true;
            grid_.hanging.push_back(c.hanging);
        }
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
    std::vector<std::uint32_t> lattice_;  ///< vertices of the root being numbered
    std::unordered_map<PlaceKey, std::uint32_t, KeyHash> edge_vertices_;
    std::vector<std::pair<PlaceKey, std::uint32_t>> edge_vertices_in_order_;
    std::unordered_set<PlaceKey, KeyHash> middles_;  ///< of edges of leaves on roots' edges
    std::vector<Candidate> candidates_;
};

}  // namespace

VertexGrid build_vertex_grid(const SurfaceMesh& mesh, const PatchHierarchy& patches) {
    return GridBuilder(mesh, patches).build();
}

}  // namespace transillum
