#include "render/hanging_vertices.h"

#include <transillum/base/disjoint_sets.h>
#include <transillum/base/sampling.h>

#include <algorithm>
#include <bit>

namespace transillum {

std::size_t HangingVertices::Hash::operator()(const glm::dvec3& p) const {
    std::uint64_t bits = 0;
    for (int i = 0; i < 3; ++i)
        bits = hash_bits(bits ^ std::bit_cast<std::uint64_t>(p[i] + 0.0));  // -0 is 0
    return bits;
}

HangingVertices::HangingVertices(const VertexGrid& grid) : grid_(grid) {
    DisjointSets surfaces(static_cast<std::uint32_t>(grid.vertex_count()));
    for (const auto& corners : grid.leaf_vertices) {
        surfaces.join(corners[0], corners[1]);
        surfaces.join(corners[0], corners[2]);
    }
    for (const VertexGrid::Hanging& h : grid.hanging) surfaces.join(h.vertex, h.from);
    vertices_.reserve(grid.vertex_count());
    for (std::uint32_t v = 0; v < grid.vertex_count(); ++v) {
        surface_.push_back(surfaces.find(v));
        vertices_.emplace(grid.positions[v], v);
    }
}

void HangingVertices::add_between(const Edge& edge, std::uint32_t surface,
                                  std::vector<Place>& places) const {
    const glm::dvec3 middle = 0.5 * (edge.from + edge.to);
    const auto [begin, end] = vertices_.equal_range(middle);
    if (begin == end || middle == edge.from || middle == edge.to) return;
    const float share = 0.5f * (edge.from_share + edge.to_share);
    std::uint32_t vertex = none;
    // The least of them: their order in the table is no one's.
    for (auto v = begin; v != end; ++v)
        if (surface_[v->second] == surface) vertex = std::min(vertex, v->second);
    add_between({edge.from, middle, edge.from_share, share}, surface, places);
    places.push_back({middle, share, vertex});
    add_between({middle, edge.to, share, edge.to_share}, surface, places);
}

std::vector<HangingVertices::Place> HangingVertices::between(std::uint32_t from,
                                                             std::uint32_t to) const {
    std::vector<Place> places;
    add_between({grid_.positions[from], grid_.positions[to], 0.0f, 1.0f}, surface_[from], places);
    return places;
}

}  // namespace transillum
