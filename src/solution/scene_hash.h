/// A number that says which scene was baked.
#pragma once

#include <transillum/geometry/surface_mesh.h>
#include <transillum/scene/lighting.h>

#include <string>

namespace transillum {

/// 64-bit FNV-1a over what light sees of a scene: geometry, materials, textures, lights and
/// environment; hexadecimal.
[[nodiscard]] std::string hash_scene(const SurfaceMesh& mesh, const Lighting& lighting);

}  // namespace transillum
