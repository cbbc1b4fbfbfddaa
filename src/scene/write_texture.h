/// Textures as image files.
#pragma once

#include "scene/read_texture.h"

#include <transillum/scene/texture.h>

#include <string>

namespace transillum {

struct EncodedImage {
    std::string png;             ///< bytes of a file
    Spectrum factor{1.0f};       ///< what read_texture gives times this is the texel
    float largest_error = 0.0f;  ///< of any channel of a texel
};

/// Three channels, of 8 bits where these give back every texel, else of 16: off by at most
/// (0.5 / 65535) * 2.28 * factor for colours (the steepest the curve of sRGB gets), 0.5 / 65535 for
/// numbers, and float rounding. \pre texels are not negative; those of numbers are at most 1
[[nodiscard]] EncodedImage encode_texture(const Texture& texture, ImageUse use);

}  // namespace transillum
