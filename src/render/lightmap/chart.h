/// A part of a lightmap: connected sides of root triangles of one object that face one way, laid
/// out without overlap by projection along the normal of the first.
#pragma once

#include <transillum/solution/solution.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace transillum {

struct RootSide {
    std::uint32_t root = 0;
    bool back = false;

    bool operator==(const RootSide&) const = default;
};

struct Chart {
    /// Texels about what it covers, into which its borders are continued. Linear filtering at its
    /// borders reads one of them.
    static constexpr int padding = 2;

    struct Triangle {
        RootSide side;
        std::array<glm::dvec2, 3> corners;  ///< [texels] from the chart's own corner, as the root's
    };

    std::uint32_t object = 0;
    std::vector<Triangle> triangles;
    int width = 0, height = 0;  ///< [texels] with the padding
    int x = 0, y = 0;           ///< where it lies in the lightmap
};

/// Cuts what shines into charts, the largest sides first.
/// \param texel its edge [scene units]
[[nodiscard]] std::vector<Chart> make_charts(const SurfaceMesh& mesh,
                                             const std::vector<RootSide>& sides, double texel);

/// Places charts within a square, in rows. \returns false where they find no room
[[nodiscard]] bool pack_charts(std::vector<Chart>& charts, int size);

/// Edges (of triangle, from its corner, to the next) that are not within the chart.
struct ChartBorder {
    std::uint32_t triangle;
    int corner;
};
[[nodiscard]] std::vector<ChartBorder> borders_of(const Chart& chart, const SurfaceMesh& mesh);

}  // namespace transillum
