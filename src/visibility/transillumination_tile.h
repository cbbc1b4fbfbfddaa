/// Inside of the transillumination buffer: a tile while it is filled.
#pragma once

#include <transillum/visibility/transillumination_buffer.h>

#include "visibility/scan_convert.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace transillum {

/// Pixels of a span that are drawn at once.
inline constexpr int block = 8;

/// A quantity that is linear over the window.
struct TransilluminationBuffer::Plane {
    double x0, y0, value, dx, dy;
    [[nodiscard]] double at(int x, int y) const { return value + dx * (x - x0) + dy * (y - y0); }
};

/// A tile being filled. Fragments are drawn in the triangles' order, then sorted by pixel and by
/// depth.
struct TransilluminationBuffer::Scratch {
    TileRect rect;
    std::vector<Fragment> drawn, sorted;
    std::vector<std::uint16_t> pixel;
    std::vector<std::uint32_t> first =
        std::vector<std::uint32_t>(tile_size * tile_size + 1 + block);
    std::size_t count = 0;
    StageSeconds seconds;

    /// Makes room for a triangle that covers the tile.
    void reserve() {
        constexpr std::size_t most = tile_size * tile_size + block;
        if (drawn.size() >= count + most) return;
        drawn.resize(2 * drawn.size() + 8 * most);
        pixel.resize(drawn.size());
    }
};

}  // namespace transillum
