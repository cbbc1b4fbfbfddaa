/// Images as textures, through OpenImageIO.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/texture.h>

#include <string>
#include <string_view>
#include <vector>

namespace transillum {

/// What an image is for: how integers are decoded, and what values make sense. Floating-point
/// images are linear.
enum class ImageUse {
    albedo,    ///< integers are sRGB; [0, 1]
    emission,  ///< integers are sRGB; 0 or more
    numbers    ///< as stored; [0, 1]
};

struct TextureImage {
    Texture texture;           ///< grey images have it in every channel
    std::vector<float> alpha;  ///< not multiplied in; one a texel, or empty
};

/// Reads 8- and 16-bit, 1-bit, palette and floating-point images with one to four channels, and the
/// R, G and B of those with more. Values that are not finite become 0 and those out of range are
/// clamped, with a warning that counts them.
/// \param name for messages and, without `bytes`, the file read
/// \param bytes of an image file held in memory
/// \throws InputError naming the image, when it is damaged or of another kind.
[[nodiscard]] TextureImage read_texture(const std::string& name, ImageUse use, Monitor& monitor,
                                        std::string_view bytes = {});

}  // namespace transillum
