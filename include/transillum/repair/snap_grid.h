/// Grids that coordinates are rounded to.
#pragma once

#include <transillum/scene/scene.h>

namespace transillum {

/// What positions may be. Whatever is made is rounded to it once.
enum class Rounding {
    doubles,  ///< any double
    floats,   ///< what a float holds: STL and glTF files
    dyadic    ///< integers below 2^40 times a power of two, so that 1-to-4 midpoints down to 12
              ///< levels are exact in double: what is baked (design: exact subdivision)
};

/// The dyadic grid: coordinate = integer * spacing, spacing = 2^exponent, integers below 2^40.
struct SnapGrid {
    int exponent = 0;
    double largest_move = 0.0;  ///< the furthest any vertex was moved [scene units]
};

/// The finest dyadic grid that holds all positions which polygons use.
/// \throws InputError on a coordinate that is no finite number.
[[nodiscard]] SnapGrid dyadic_grid(const Scene& scene);

/// To the nearest point of the grid; halves go to even.
[[nodiscard]] glm::dvec3 snap(const glm::dvec3& p, const SnapGrid& grid);

/// Rounds positions.
struct VertexRounding {
    Rounding rounding = Rounding::doubles;
    SnapGrid grid;  ///< of `dyadic`

    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& p) const;
};

/// Absolute values that the largest coordinate may have where it is dyadic [scene units]: areas and
/// their products then stay well within what floats hold, which light is worked out in.
inline constexpr double least_extent = 1e-15, most_extent = 1e15;
/// \throws InputError where the largest coordinate that polygons use is outside, or is no number
void require_extent(const Scene& scene);

/// Rounds every position that a polygon uses; says how far the furthest was moved.
/// \throws InputError on a coordinate that is no finite number; dyadic: where the largest is
/// outside [least_extent, most_extent].
SnapGrid snap_scene(Scene& scene, Rounding rounding);

}  // namespace transillum
