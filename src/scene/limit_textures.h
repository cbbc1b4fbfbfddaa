/// The part of limit_albedo that goes texel by texel.
#pragma once

#include <transillum/scene/scene.h>

namespace transillum {

/// Bound of what a material reflects anywhere on its textures [1]; reached where they share a grid.
[[nodiscard]] Spectrum largest_albedo(const Scene& scene, const Material& material);

/// Limits every texel of a material's reflectances, in new textures; its values become their means.
void limit_textures(Scene& scene, Material& material, float max_albedo);

}  // namespace transillum
