/// Which patches the value at a vertex of the subdivision is a mean of, for values that are
/// evaluated patch by patch as they are needed.
#pragma once

#include "render/vertex_grid.h"

#include <transillum/solution/solution.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

class VertexStencils {
public:
    struct Entry {
        std::uint32_t patch, side;  ///< index into GlossySides::sides
        float weight;               ///< those of a vertex add up to 1
    };

    VertexStencils() = default;
    /// Of the glossy sides alone; patches have a say by their coverage.
    VertexStencils(const Solution& solution, const VertexGrid& grid);

    /// Empty where no glossy side of that facing touches the vertex.
    [[nodiscard]] std::span<const Entry> at(std::uint32_t vertex, bool back) const {
        const std::size_t i = 2 * std::size_t{vertex} + (back ? 1 : 0);
        return {entries_.data() + first_[i], entries_.data() + first_[i + 1]};
    }

private:
    std::vector<std::uint32_t> first_;  ///< 2 * vertex + back
    std::vector<Entry> entries_;
};

}  // namespace transillum
