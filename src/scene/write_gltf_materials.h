/// Materials as glTF's metallic-roughness.
#pragma once

#include "scene/gltf_builder.h"

namespace transillum {

/// Adds every material of the scene, in its order, and the images of those that polygons have.
///
/// A Material's diffuse and specular reflectance are base (1 - metallic) and F0 (1 - metallic) +
/// base metallic. Without specular texture, metallic is 0 and F0 = specular
/// (KHR_materials_specular), or 1 where diffuse is 0; with one, F0 is the 0.04 of dielectrics and
/// metallic is solved for, texel by texel. What of such a texture has no solution is warned of.
void write_gltf_materials(GltfBuilder& builder);

}  // namespace transillum
