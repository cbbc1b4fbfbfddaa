#include "scene/mean_colour.h"

#include <transillum/base/error.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace transillum {

namespace {

/// Larger than any texture, smaller than what a damaged header may claim.
constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

double linear_from_srgb(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

std::vector<float> read_pixels(OIIO::ImageInput& image, const std::string& name) {
    const OIIO::ImageSpec& spec = image.spec();
    const auto pixels = static_cast<std::int64_t>(spec.image_pixels());
    if (pixels < 1 || pixels > most_pixels || spec.nchannels < 1 || spec.nchannels > 16)
        throw InputError(name, "an image of " + std::to_string(spec.width) + " x " +
                                   std::to_string(spec.height) + " pixels; accepted: 1 to " +
                                   std::to_string(most_pixels) + " pixels");
    std::vector<float> values(static_cast<std::size_t>(pixels) *
                              static_cast<std::size_t>(spec.nchannels));
    if (!image.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
        throw InputError(name, "cannot be read as an image: " + first_line(image.geterror()));
    return values;
}

}  // namespace

glm::dvec4 mean_colour(const std::string& name, std::string_view bytes) {
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    OIIO::Filesystem::IOProxy* proxy = &memory;
    std::string file = name;
    if (!bytes.empty()) {
        config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
        // The reader is chosen by the extension.
        file = bytes.starts_with("\x89PNG") ? "image.png" : "image.jpg";
    }
    const auto image = OIIO::ImageInput::open(file, &config);
    if (!image)
        throw InputError(name, "cannot be read as an image: " + first_line(OIIO::geterror()));
    const OIIO::ImageSpec spec = image->spec();
    const std::vector<float> values = read_pixels(*image, name);

    const bool encoded = !spec.format.is_floating_point();
    const int channels = spec.nchannels;
    const int colours = channels < 3 ? 1 : 3;
    glm::dvec4 sum(0.0);
    for (std::size_t p = 0; p < values.size(); p += static_cast<std::size_t>(channels)) {
        for (int c = 0; c < 3; ++c) {
            const double v = values[p + static_cast<std::size_t>(colours == 3 ? c : 0)];
            sum[c] += encoded ? linear_from_srgb(v) : v;
        }
        sum.a += channels > colours
                     ? static_cast<double>(values[p + static_cast<std::size_t>(colours)])
                     : 1.0;
    }
    const glm::dvec4 mean =
        sum / static_cast<double>(values.size() / static_cast<std::size_t>(channels));
    for (int c = 0; c < 4; ++c)
        if (!(mean[c] >= 0.0 && mean[c] <= 1.0))
            throw InputError(name, "the mean colour has a channel of " + std::to_string(mean[c]) +
                                       "; accepted: 0 to 1");
    return mean;
}

}  // namespace transillum
