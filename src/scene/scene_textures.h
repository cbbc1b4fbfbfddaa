/// What the readers of every format do with the textures of a scene.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <cstdint>
#include <vector>

namespace transillum {

/// A property of a material: its mean, and its texture where it varies.
struct Textured {
    Spectrum mean{0.0f};
    std::int32_t texture = -1;  ///< index into Scene::textures
};

/// Adds a texture to a scene, unless all its texels are alike. \throws InputError where the scene's
/// textures get larger than memory is likely to be.
[[nodiscard]] Textured add_texture(Scene& scene, Texture texture);

/// Drops textures that no material names any more.
void drop_unused_textures(Scene& scene);

/// Polygons without texture coordinates get a copy of their material that has the means of its
/// textures, with a warning; textures that no face can show are dropped. \param has_uvs one a
/// polygon. \throws InputError naming a polygon with a texture coordinate that is not finite.
void finish_textures(Scene& scene, const std::vector<std::uint8_t>& has_uvs, Monitor& monitor);

}  // namespace transillum
