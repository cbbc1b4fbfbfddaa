/// Vertices without a polygon would only widen boxes and grids.
#pragma once

#include <transillum/scene/scene.h>

#include <vector>

namespace transillum {

/// Which positions polygons use. \throws InputError naming one that is no finite number.
[[nodiscard]] std::vector<bool> used_positions(const Scene& scene);

}  // namespace transillum
