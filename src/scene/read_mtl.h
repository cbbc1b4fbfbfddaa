/// Wavefront material libraries.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <glm/vec2.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace transillum {

/// A `map_` statement; the texture coordinates are scaled (`-s`), then moved (`-o`).
struct MtlMap {
    std::string file;  ///< empty where there is no such statement
    glm::vec2 scale{1.0f}, offset{0.0f};
    bool clamp = false;      ///< `-clamp on`: the image does not repeat
    Spectrum without{0.0f};  ///< what the material has if the file is not there
};

struct MtlMaterial {
    Material material;                                     ///< its values are the maps' factors
    MtlMap diffuse_map{}, specular_map{}, emission_map{};  ///< `map_Kd`, `map_Ks`, `map_Ke`
};

/// `Ks` and `Ns` are a max-Phong lobe where `illum` is absent or at least 2. A map without its
/// `Kd`, `Ks` or `Ke` stands alone; without `Kd` and map half the light is reflected. Statements
/// that are not honoured go to the monitor. \throws InputError naming file and line: Kd or Ks
/// outside [0, 1], negative Ke or Ns, opacity outside [0, 1]; IoError.
[[nodiscard]] std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path,
                                                Monitor& monitor);

}  // namespace transillum
