/// How far two surfaces are from each other.
#pragma once

#include <transillum/base/parallel.h>
#include <transillum/repair/triangle_soup.h>

#include <cstdint>

namespace transillum::testing_support {

struct SurfaceDistance {
    double forth = 0.0;         ///< of samples on the first from the second, the largest
    double back = 0.0;          ///< the other way
    std::uint64_t samples = 0;  ///< on both
};

/// Two-sided Hausdorff distance, sampled: corners, edge midpoints and centre of every triangle with
/// area, and at least `random` points a surface, spread by area. What rounding adds is some 1e-16
/// of the coordinates.
[[nodiscard]] SurfaceDistance surface_distance(const TriangleSoup& a, const TriangleSoup& b,
                                               std::uint64_t random, const Workers& workers);

}  // namespace transillum::testing_support
