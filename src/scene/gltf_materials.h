/// Materials of a glTF document.
#pragma once

#include "scene/gltf_document.h"
#include "scene/gltf_textures.h"

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <vector>

namespace transillum {

/// One a glTF material, textures left aside. diffuse = base colour times (1 - metallic); a GGX lobe
/// of specular = reflectance of a dielectric to base colour, by metallic. The dielectric's is 0.04,
/// or as KHR_materials_ior and KHR_materials_specular say; where the lobe reflects nothing, there
/// is none. emission = emissive factor times KHR_materials_emissive_strength. Opacity is 1 less
/// KHR_materials_transmission, times alpha where alphaMode is BLEND. \throws InputError naming the
/// material.
[[nodiscard]] std::vector<Material> read_gltf_materials(const GltfDocument& document,
                                                        Monitor& monitor);

/// How a material's base colour and metalness reflect.
[[nodiscard]] GltfReflection read_gltf_reflection(const GltfDocument& document, std::size_t index);

}  // namespace transillum
