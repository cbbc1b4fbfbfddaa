/// All of a scene that has a colour, as RGB or in bands of wavelengths.
#pragma once

#include <transillum/scene/bands.h>
#include <transillum/scene/scene.h>

#include <memory>
#include <vector>

namespace transillum {

struct Colours {
    std::vector<Material> materials;
    std::vector<std::shared_ptr<const Texture>> textures;
    Lighting lighting;
};

/// Reflectance that lobes keep in bands where they reflect nothing, so that all groups agree on
/// which surfaces are glossy.
inline constexpr float least_specular = 1e-6f;

/// RGB as a group of bands: materials, lights, environment, and textures texel by texel. Textures
/// that hold no colours are shared.
[[nodiscard]] Colours colours_in_group(const Colours& rgb, const Bands& bands, int group);

}  // namespace transillum
