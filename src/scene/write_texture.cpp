#include "scene/write_texture.h"

#include <transillum/base/error.h>
#include <transillum/base/srgb.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace transillum {

namespace {

/// As read_texture decodes.
float decode(int stored, int last, ImageUse use) {
    const float share = static_cast<float>(stored) / static_cast<float>(last);
    return use == ImageUse::numbers ? share : linear_from_srgb(share);
}

int encode(float value, int last, ImageUse use) {
    const float share = use == ImageUse::numbers ? value : srgb_from_linear(value);
    return static_cast<int>(std::lround(std::clamp(share, 0.0f, 1.0f) * static_cast<float>(last)));
}

template <class Integer>
struct Stored {
    std::vector<Integer> values;
    float largest_error = 0.0f;
};

template <class Integer>
Stored<Integer> store(const Texture& texture, const Spectrum& factor, ImageUse use) {
    constexpr int last = std::numeric_limits<Integer>::max();
    Stored<Integer> stored;
    stored.values.reserve(3 * texture.texels.size());
    for (const Spectrum& texel : texture.texels)
        for (int c = 0; c < channel_count; ++c) {
            const int value = encode(texel[c] / factor[c], last, use);
            stored.values.push_back(static_cast<Integer>(value));
            const float error = std::abs(decode(value, last, use) * factor[c] - texel[c]);
            stored.largest_error = std::max(stored.largest_error, error);
        }
    return stored;
}

template <class Integer>
std::string encode_png(const Texture& texture, const std::vector<Integer>& values) {
    const auto type = sizeof(Integer) == 1 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16;
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    OIIO::Filesystem::IOProxy* proxy = &memory;
    OIIO::ImageSpec spec(texture.width, texture.height, 3, type);
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto image = OIIO::ImageOutput::create("image.png");
    if (!image || !image->open("image.png", spec) || !image->write_image(type, values.data()) ||
        !image->close())
        throw IoError(texture.name, "cannot be written as PNG: " +
                                        (image ? image->geterror() : OIIO::geterror()));
    return {bytes.begin(), bytes.end()};
}

std::optional<EncodedImage> encode_exactly(const Texture& texture, const Spectrum& factor,
                                           ImageUse use) {
    const auto stored = store<std::uint8_t>(texture, factor, use);
    if (stored.largest_error > 0.0f) return std::nullopt;
    return EncodedImage{encode_png(texture, stored.values), factor, 0.0f};
}

}  // namespace

EncodedImage encode_texture(const Texture& texture, ImageUse use) {
    if (auto exact = encode_exactly(texture, Spectrum(1.0f), use)) return std::move(*exact);
    Spectrum largest(0.0f);
    for (const Spectrum& texel : texture.texels) largest = glm::max(largest, texel);
    Spectrum factor(1.0f);
    if (use != ImageUse::numbers)
        for (int c = 0; c < channel_count; ++c)
            if (largest[c] > 0.0f) factor[c] = largest[c];
    if (auto exact = encode_exactly(texture, factor, use)) return std::move(*exact);
    const auto stored = store<std::uint16_t>(texture, factor, use);
    return {encode_png(texture, stored.values), factor, stored.largest_error};
}

}  // namespace transillum
