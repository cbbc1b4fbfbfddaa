/// STL, ASCII and binary.
#pragma once

#include <transillum/scene/scene.h>

#include <filesystem>

namespace transillum {

/// Normals in the file are not used: the front is where the corners turn counter-clockwise.
/// \throws InputError naming file and line or facet; IoError.
[[nodiscard]] Scene read_stl(const std::filesystem::path& path);

}  // namespace transillum
