/// The promise of a Solution's parts to each other, kept at both ends: nothing wrong is written or
/// read.
#pragma once

#include <transillum/solution/solution.h>

#include <string>

namespace transillum {

/// What is wrong with it first: counts that do not agree, an index out of bounds, a value that is
/// not finite or out of range. Empty where nothing is.
[[nodiscard]] std::string find_defect(const Solution& solution);

}  // namespace transillum
