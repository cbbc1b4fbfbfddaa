/// Where leaves of other sizes have vertices within the edges of a leaf.
#pragma once

#include "render/vertex_grid.h"

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace transillum {

class HangingVertices {
public:
    explicit HangingVertices(const VertexGrid& grid);

    /// Vertices within an edge of a leaf, in order from one end to the other.
    [[nodiscard]] std::vector<std::uint32_t> between(std::uint32_t from, std::uint32_t to) const;

private:
    /// By its ends, the lower one first.
    using Line = std::pair<std::uint32_t, std::uint32_t>;
    struct Place {
        Line line;
        float share;  ///< of the way from its lower end
    };
    struct Hash {
        std::size_t operator()(const Line& line) const;
    };
    /// Negative where the vertex is not on the line.
    [[nodiscard]] float share_on(const Line& line, std::uint32_t vertex) const;

    std::unordered_map<std::uint32_t, Place> places_;
    std::unordered_map<Line, std::vector<std::pair<float, std::uint32_t>>, Hash> lines_;
};

}  // namespace transillum
