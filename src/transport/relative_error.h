/// The error of a whole solution in one number.
#pragma once

#include "transport/finite_elements.h"

#include <span>

namespace transillum {

/// Root mean square standard error over the mean, both weighted with area, of the luminance that
/// arrives; NaN where nothing is known. \param leaf_area one a leaf
[[nodiscard]] double estimate_relative_error(const FiniteElementComponent& component,
                                             std::span<const double> leaf_area,
                                             const Workers& workers);

}  // namespace transillum
