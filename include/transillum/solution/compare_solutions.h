/// How far one solution is from another of the same patches.
#pragma once

#include <transillum/solution/solution.h>

#include <cstdint>

namespace transillum {

struct SolutionDifference {
    double bias = 0.0;           ///< (mean of a - mean of b) / mean of b
    double relative_rmse = 0.0;  ///< root mean square difference / mean of b
    double largest = 0.0;        ///< largest |difference| / mean of b
    std::uint64_t patches = 0;   ///< compared: those that reflect and were seen in either
};

/// Luminance of the irradiance, direct and indirect, weighted with area; a against the reference b.
/// \throws InputError when they are not of the same surface and patches.
[[nodiscard]] SolutionDifference compare_solutions(const Solution& a, const Solution& b);

}  // namespace transillum
