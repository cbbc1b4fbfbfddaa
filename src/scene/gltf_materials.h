/// Materials of a glTF document.
#pragma once

#include "scene/gltf_document.h"

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <vector>

namespace transillum {

/// One a glTF material, textures left aside. diffuse = base colour times (1 - metallic), specular =
/// base colour times metallic, emission = emissive factor times KHR_materials_emissive_strength.
/// Opacity is 1 less KHR_materials_transmission, times alpha where alphaMode is BLEND. \throws
/// InputError naming the material.
[[nodiscard]] std::vector<Material> read_gltf_materials(const GltfDocument& document,
                                                        Monitor& monitor);

}  // namespace transillum
