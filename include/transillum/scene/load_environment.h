/// Lat-long images as environments.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/environment.h>

#include <filesystem>

namespace transillum {

/// Reads what OpenImageIO reads: Radiance .hdr and OpenEXR are taken as linear, integer formats as
/// sRGB, one channel as grey; further channels are left out. Pixels that are not finite or negative
/// become 0 and are counted in a warning; so is an image that is not twice as wide as high.
/// \throws IoError when the file is not there, InputError naming it when it is no whole image.
[[nodiscard]] Environment load_environment(const std::filesystem::path& path, Monitor& monitor);

}  // namespace transillum
