/// PLY: ASCII and binary of either byte order.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <filesystem>

namespace transillum {

/// Reads `x y z` of `vertex` and `vertex_indices` or `vertex_index` of `face`; other elements and
/// properties are passed over, colours with a note.
/// \throws InputError naming file and line, or vertex or face; IoError.
[[nodiscard]] Scene read_ply(const std::filesystem::path& path, Monitor& monitor);

}  // namespace transillum
