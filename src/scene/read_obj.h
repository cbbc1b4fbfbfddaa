/// Wavefront OBJ with its material libraries.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <filesystem>

namespace transillum {

/// Polygons, texture coordinates, materials, objects (`o`, or `g` where there is no `o`), and
/// cameras in comments (obj_cameras.h).
/// Lines, points and free-form geometry are left out with a note; a missing library or material is
/// replaced by the default material with a warning. \throws InputError naming file and line, or
/// material; IoError.
[[nodiscard]] Scene read_obj(const std::filesystem::path& path, Monitor& monitor);

}  // namespace transillum
