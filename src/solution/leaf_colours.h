/// What textures leave of a material on a leaf.
#pragma once

#include <transillum/solution/solution.h>

namespace transillum {

/// Fills Solution::leaf_diffuse and leaf_emission with means over the leaves, where some material
/// in use has such a texture. They follow from the surface, so files don't hold them.
void average_textures(Solution& solution);

}  // namespace transillum
