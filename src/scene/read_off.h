/// Geomview OFF, ASCII: OFF and its prefixes C (colours), N (normals), ST (texture coordinates).
#pragma once

#include <transillum/scene/scene.h>

#include <filesystem>

namespace transillum {

/// \throws InputError naming file and line; IoError.
[[nodiscard]] Scene read_off(const std::filesystem::path& path);

}  // namespace transillum
