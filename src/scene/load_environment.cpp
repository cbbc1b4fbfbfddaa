#include <transillum/scene/load_environment.h>

#include "scene/text_reader.h"

#include <transillum/base/error.h>

#include <OpenImageIO/imageio.h>

#include <cmath>

namespace transillum {

namespace {

/// Larger than any environment, smaller than what a damaged header may claim.
constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

std::string size_of(const OIIO::ImageSpec& spec) {
    return std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
}

void check_shape(const OIIO::ImageSpec& spec, const std::string& name, Monitor& monitor) {
    const auto pixels = static_cast<std::int64_t>(spec.width) * spec.height;
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || pixels > most_pixels ||
        spec.nchannels < 1 || spec.nchannels > 16)
        throw InputError(name, "an image of " + size_of(spec) + " and " +
                                   std::to_string(spec.nchannels) + " channels; accepted: 1 to " +
                                   std::to_string(most_pixels) + " pixels, 1 to 16 channels");
    if (spec.width != spec.full_width || spec.height != spec.full_height)
        throw InputError(name, "holds only " + size_of(spec) + " of " +
                                   std::to_string(spec.full_width) + " x " +
                                   std::to_string(spec.full_height) + "; accepted: a whole image");
    if (spec.width != 2 * spec.height)
        monitor.warn(
            name + ": " + size_of(spec) +
            "; a lat-long image is twice as wide as high: it is stretched over the sphere");
}

double linear_from_srgb(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

struct Spoilt {
    std::size_t not_finite = 0, negative = 0;
};

Spectrum sound(Spectrum texel, Spoilt& spoilt) {
    if (!is_finite(texel)) {
        ++spoilt.not_finite;
        return Spectrum(0.0f);
    }
    const Spectrum sound = glm::max(texel, Spectrum(0.0f));
    if (sound != texel) ++spoilt.negative;
    return sound;
}

void warn_of(const Spoilt& spoilt, const Texture& image, Monitor& monitor) {
    if (spoilt.not_finite + spoilt.negative == 0) return;
    monitor.warn(image.name + ": of " + std::to_string(image.texels.size()) + " pixels " +
                 std::to_string(spoilt.not_finite) + " are NaN or infinite and set to 0, " +
                 std::to_string(spoilt.negative) + " have channels below 0, which are set to 0");
}

}  // namespace

Environment load_environment(const std::filesystem::path& path, Monitor& monitor) {
    const std::string name = path.string();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        throw IoError(name, "there is no such file");
    const auto input = OIIO::ImageInput::open(name);
    if (!input)
        throw InputError(name, "cannot be read as an image: " + first_line(OIIO::geterror()));
    const OIIO::ImageSpec spec = input->spec();
    check_shape(spec, name, monitor);
    const int channels = spec.nchannels < 3 ? 1 : 3;
    const std::size_t pixels = static_cast<std::size_t>(spec.width) * spec.height;
    std::vector<float> values(pixels * channels);
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data()))
        throw InputError(name, "cannot be read as an image: " + first_line(input->geterror()));

    auto image = std::make_shared<Texture>();
    image->name = name;
    image->width = spec.width;
    image->height = spec.height;
    image->wrap_v = Texture::Wrap::clamp;
    image->texels.reserve(pixels);
    const bool encoded = !spec.format.is_floating_point();
    Spoilt spoilt;
    for (std::size_t i = 0; i < pixels; ++i) {
        Spectrum texel;
        for (int c = 0; c < channel_count; ++c) {
            const float v = values[i * channels + (channels == 3 ? c : 0)];
            texel[c] = encoded ? static_cast<float>(linear_from_srgb(v)) : v;
        }
        image->texels.push_back(sound(texel, spoilt));
    }
    warn_of(spoilt, *image, monitor);
    Environment environment;
    environment.kind = Environment::Kind::image;
    environment.image = std::move(image);
    return environment;
}

}  // namespace transillum
