#include "render/tone_mapping.h"

#include <transillum/base/error.h>
#include <transillum/render/image.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace transillum {

namespace {

namespace fs = std::filesystem;
constexpr const char* mask_channel = "emitter.mask";

/// What goes into a file: rows of interleaved channels.
struct Raster {
    int width = 0, height = 0;
    std::vector<std::string> channels;
    std::vector<float> values;
    OIIO::TypeDesc stored_as = OIIO::TypeDesc::FLOAT;
};

std::string lower_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

void check_pixels(const Image& image, const fs::path& path) {
    const auto count = static_cast<std::size_t>(image.width) * image.height;
    if (image.width < 1 || image.height < 1 || image.pixels.size() != count ||
        (!image.emitter_mask.empty() && image.emitter_mask.size() != count))
        throw InputError(path.string(), "an image of " + std::to_string(image.width) + "x" +
                                            std::to_string(image.height) + " with " +
                                            std::to_string(image.pixels.size()) + " pixels");
    for (std::size_t i = 0; i < count; ++i)
        if (!is_finite(image.pixels[i]))
            throw InputError(path.string(), "pixel (" + std::to_string(i % image.width) + ", " +
                                                std::to_string(i / image.width) +
                                                ") is not finite; accepted: finite values");
}

Raster linear_raster(const Image& image) {
    Raster raster{image.width, image.height, {"R", "G", "B"}, {}, OIIO::TypeDesc::FLOAT};
    if (!image.emitter_mask.empty()) raster.channels.emplace_back(mask_channel);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (int c = 0; c < channel_count; ++c) raster.values.push_back(image.pixels[i][c]);
        if (!image.emitter_mask.empty()) raster.values.push_back(image.emitter_mask[i]);
    }
    return raster;
}

Raster display_raster(const Image& image, const ToneMapping& tone) {
    Raster raster{image.width, image.height, {"R", "G", "B"}, {}, OIIO::TypeDesc::UINT8};
    const float factor = exposure_factor(image, tone);
    for (const Spectrum& pixel : image.pixels) {
        const Spectrum shown = compress_highlights(factor * pixel);
        for (int c = 0; c < channel_count; ++c) raster.values.push_back(srgb_from_linear(shown[c]));
    }
    return raster;
}

/// \param memory null: into a file of that name
void write_raster(const Raster& raster, const fs::path& path, const fs::path& named,
                  OIIO::Filesystem::IOProxy* memory = nullptr) {
    auto file = OIIO::ImageOutput::create(path.string(), memory);
    if (!file) throw IoError(named.string(), "cannot write: " + OIIO::geterror());
    OIIO::ImageSpec spec(raster.width, raster.height, static_cast<int>(raster.channels.size()),
                         raster.stored_as);
    spec.channelnames = raster.channels;
    // Else the time of writing is stored, and equal images would be different files.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    // A fifth larger than the default's, and half a second sooner at 2048 x 2048.
    if (memory) spec.attribute("png:compressionLevel", 3);
    const bool written = file->open(path.string(), spec) &&
                         file->write_image(OIIO::TypeDesc::FLOAT, raster.values.data());
    if (!file->close() || !written)
        throw IoError(named.string(), "cannot write: " + file->geterror());
}

int channel_named(const OIIO::ImageSpec& spec, const char* name) {
    const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    return found == spec.channelnames.end() ? -1
                                            : static_cast<int>(found - spec.channelnames.begin());
}

/// Where red, green and blue lie; a grey image serves as all three.
std::array<int, channel_count> colour_channels(const OIIO::ImageSpec& spec) {
    const std::array<int, channel_count> rgb{channel_named(spec, "R"), channel_named(spec, "G"),
                                             channel_named(spec, "B")};
    if (*std::min_element(rgb.begin(), rgb.end()) >= 0) return rgb;
    return spec.nchannels >= 3 ? std::array<int, channel_count>{0, 1, 2}
                               : std::array<int, channel_count>{0, 0, 0};
}

}  // namespace

void write_image(const Image& image, const fs::path& path, const ToneMapping& tone) {
    const std::string extension = lower_extension(path);
    if (extension != ".exr" && extension != ".png")
        throw UsageError(path.string() + ": extension '" + extension + "'; accepted: .exr, .png");
    check_pixels(image, path);
    // The extension stays last: it tells OpenImageIO the format.
    const fs::path partial = path.string() + ".partial-" + std::to_string(getpid()) + extension;
    std::error_code ignored, failed;
    try {
        write_raster(extension == ".exr" ? linear_raster(image) : display_raster(image, tone),
                     partial, path);
    } catch (...) {
        fs::remove(partial, ignored);
        throw;
    }
    fs::rename(partial, path, failed);
    if (!failed) return;
    fs::remove(partial, ignored);
    throw IoError(path.string(), "cannot write: " + failed.message());
}

std::string png_bytes(const Image& image, const ToneMapping& tone) {
    const fs::path named = "picture.png";
    check_pixels(image, named);
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    write_raster(display_raster(image, tone), named, named, &memory);
    return {bytes.begin(), bytes.end()};
}

Image read_image(const fs::path& path) {
    if (!fs::exists(path)) throw IoError(path.string(), "no such file");
    auto file = OIIO::ImageInput::open(path.string());
    if (!file) throw InputError(path.string(), "not a readable image: " + OIIO::geterror());
    const OIIO::ImageSpec spec = file->spec();
    std::vector<float> values(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels);
    if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
        throw InputError(path.string(), "truncated or corrupt: " + file->geterror());

    const auto rgb = colour_channels(spec);
    const int mask = channel_named(spec, mask_channel);
    const bool encoded = !spec.format.is_floating_point();
    Image image{spec.width, spec.height, {}, {}};
    for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(spec.nchannels)) {
        Spectrum& pixel = image.pixels.emplace_back();
        for (int c = 0; c < channel_count; ++c)
            pixel[c] = encoded ? linear_from_srgb(values[i + rgb[c]]) : values[i + rgb[c]];
        if (mask >= 0) image.emitter_mask.push_back(values[i + mask]);
    }
    return image;
}

}  // namespace transillum
