/// A part of a lightmap: connected sides of root triangles of one object that face one way, laid
/// out without overlap by projection along the normal of the first.
#pragma once

#include <transillum/solution/solution.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <unordered_map>
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
class ChartMaker {
public:
    /// Keeps references.
    ChartMaker(const SurfaceMesh& mesh, const std::vector<RootSide>& sides);

    /// \param texel its edge [scene units]
    [[nodiscard]] std::vector<Chart> make(double texel) const;

private:
    Chart grow(std::uint32_t first, double texel, std::vector<std::uint8_t>& is_taken) const;
    [[nodiscard]] bool belongs(std::uint32_t side, std::uint32_t object,
                               const glm::dvec3& normal) const;

    const SurfaceMesh& mesh_;
    const std::vector<RootSide>& sides_;
    std::vector<std::uint32_t> order_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> sides_at_;  ///< edges
};

/// Places charts within a square, in rows. \returns false where they find no room
[[nodiscard]] bool pack_charts(std::vector<Chart>& charts, int size);

/// Edges (of triangle, from its corner, to the next) that are not within the chart.
struct ChartBorder {
    std::uint32_t triangle;
    int corner;
};
[[nodiscard]] std::vector<ChartBorder> borders_of(const Chart& chart, const SurfaceMesh& mesh);

}  // namespace transillum
