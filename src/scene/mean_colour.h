/// The mean colour of an image.
#pragma once

#include <glm/vec4.hpp>

#include <string>
#include <string_view>

namespace transillum {

/// Linear mean of the colour channels (integer formats are taken as sRGB, floating point as linear)
/// and of alpha, which is not multiplied in; 1 without alpha.
/// \param name for messages and, without `bytes`, the file read
/// \param bytes of a PNG or JPEG held in memory
/// \throws InputError naming the image.
[[nodiscard]] glm::dvec4 mean_colour(const std::string& name, std::string_view bytes = {});

}  // namespace transillum
