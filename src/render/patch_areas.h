/// How much patches count where all of their surface is known alike.
#pragma once

#include <transillum/solution/solution.h>

#include <vector>

namespace transillum {

/// [square scene units], one a patch.
[[nodiscard]] std::vector<float> patch_areas(const Solution& solution);

}  // namespace transillum
