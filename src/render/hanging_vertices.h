/// Where leaves of other sizes, or of other surfaces, have vertices within the edges of a leaf.
#pragma once

#include "render/vertex_grid.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace transillum {

class HangingVertices {
public:
    /// Keeps a reference.
    explicit HangingVertices(const VertexGrid& grid);

    static constexpr std::uint32_t none = 0xffffffffu;
    struct Place {
        glm::dvec3 position;
        float share;           ///< of the way from one end to the other
        std::uint32_t vertex;  ///< of the same smooth surface as the ends, or none
    };
    /// Within an edge of a leaf, in order from one end to the other. Vertices are midpoints of
    /// edges, exactly: they are found by their place.
    [[nodiscard]] std::vector<Place> between(std::uint32_t from, std::uint32_t to) const;

private:
    struct Hash {
        std::size_t operator()(const glm::dvec3& p) const;
    };
    struct Edge {
        glm::dvec3 from, to;
        float from_share, to_share;
    };
    void add_between(const Edge& edge, std::uint32_t surface, std::vector<Place>& places) const;

    const VertexGrid& grid_;
    std::vector<std::uint32_t> surface_;  ///< of each vertex, one of its vertices
    std::unordered_multimap<glm::dvec3, std::uint32_t, Hash> vertices_;
};

}  // namespace transillum
