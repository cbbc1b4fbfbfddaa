/// Wavefront material libraries.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <filesystem>
#include <string>
#include <vector>

namespace transillum {

struct MtlMaterial {
    Material material;
    std::string diffuse_map;  ///< file named by `map_Kd`, empty where there is none
};

/// `Ks` and `Ns` are a max-Phong lobe where `illum` is absent or at least 2; without `Kd` a map
/// stands alone, or half the light is reflected. Statements that are not honoured go to the
/// monitor. \throws InputError naming file and line: Kd or Ks outside [0, 1], negative Ke or Ns,
/// opacity outside [0, 1]; IoError.
[[nodiscard]] std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path,
                                                Monitor& monitor);

}  // namespace transillum
