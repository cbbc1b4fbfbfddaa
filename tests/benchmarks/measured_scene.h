/// Scenes from files, as `bake` and `reference` take them.
#pragma once

#include <transillum/scene/scene.h>

#include <string>

namespace transillum::benchmarks {

/// Loaded, albedos limited as by default. \throws what load_scene() does
[[nodiscard]] Scene load_measured_scene(const std::string& path);

}  // namespace transillum::benchmarks
