/// Textures of a glTF document. Its images give colour, metalness and roughness; a Material has
/// diffuse and specular reflectance, so textures of those are made from them.
#pragma once

#include "scene/gltf_document.h"
#include "scene/gltf_reflection.h"

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <glm/mat2x2.hpp>

#include <cstddef>
#include <map>
#include <string>

namespace transillum {

/// Which texture coordinates a material takes, and how it moves them (KHR_texture_transform).
struct TextureFrame {
    std::size_t set = 0;  ///< attribute TEXCOORD_set
    glm::mat2 turn{1.0f};
    glm::vec2 offset{0.0f};

    [[nodiscard]] glm::vec2 apply(const glm::vec2& uv) const { return turn * uv + offset; }
    bool operator==(const TextureFrame&) const = default;
};

class GltfTextures {
public:
    GltfTextures(const GltfDocument& document, Monitor& monitor)
        : document_(document), monitor_(monitor) {}

    /// That of the material's base colour texture, else of its metallic-roughness or its emissive
    /// texture. \throws InputError
    [[nodiscard]] TextureFrame frame_of(std::size_t material) const;

    /// Sets the textures of a material and their means; a missing image is warned of, and the
    /// uniform factor is taken. BLEND materials are as opaque as their texture is in the mean.
    /// \throws InputError naming material and image
    void apply(std::size_t index, const GltfReflection& reflection, Scene& scene);

private:
    const GltfDocument& document_;
    Monitor& monitor_;
    /// Materials that were given textures, by all that these depend on.
    std::map<std::string, std::size_t> material_of_key_;
};

}  // namespace transillum
