/// A number that says which scene was baked.
#pragma once

#include <transillum/geometry/surface_mesh.h>
#include <transillum/scene/scene.h>

#include <string>
#include <utility>
#include <vector>

namespace transillum {

/// 64-bit FNV-1a over what light sees of a scene: geometry, materials, textures, lights and
/// environment; hexadecimal.
[[nodiscard]] std::string hash_scene(const SurfaceMesh& mesh, const Lighting& lighting);

/// Over all that a bake begins with: the scene as it was read, the options by name, and the
/// program's version.
[[nodiscard]] std::string hash_input(
    const Scene& scene, const std::vector<std::pair<std::string, std::string>>& settings);

}  // namespace transillum
