#include "scene/read_texture.h"

#include <transillum/base/error.h>
#include <transillum/base/srgb.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>

namespace transillum {

namespace {

/// Larger than any texture, smaller than what a damaged header may claim.
constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

/// An image of one bit and one colour is deflated to a byte for 8256 pixels.
constexpr int most_pixels_per_byte = 10000;
constexpr std::int64_t always_accepted = std::int64_t{1} << 20;

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

/// Channels that hold a texel; alpha is -1 where there is none.
struct Channels {
    std::array<int, 3> colour{};
    int alpha = -1;
};

Channels find_channels(const OIIO::ImageSpec& spec, const std::string& name) {
    const int count = spec.nchannels;
    Channels channels{{0, 0, 0}, spec.alpha_channel};
    if (spec.channelindex("R") >= 0 && spec.channelindex("G") >= 0 && spec.channelindex("B") >= 0) {
        channels.colour = {spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
        return channels;
    }
    if (count > 4)
        throw InputError(name, "an image of " + std::to_string(count) +
                                   " channels, none of them R, G and B; accepted: 1 to 4 channels");
    if (count >= 3) channels.colour = {0, 1, 2};
    if (count % 2 == 0 && channels.alpha < 0) channels.alpha = count - 1;
    return channels;
}

void check_size(const OIIO::ImageSpec& spec, const std::string& name, std::uintmax_t bytes) {
    const auto pixels = static_cast<std::int64_t>(spec.image_pixels());
    if (spec.deep || spec.depth > 1)
        throw InputError(name, "a deep or volume image; accepted: flat images");
    if (pixels < 1 || pixels > most_pixels || spec.nchannels < 1 || spec.nchannels > 64)
        throw InputError(name, "an image of " + std::to_string(spec.width) + " x " +
                                   std::to_string(spec.height) + " pixels, " +
                                   std::to_string(spec.nchannels) + " channels; accepted: 1 to " +
                                   std::to_string(most_pixels) + " pixels, 1 to 64 channels");
    if (pixels > always_accepted &&
        static_cast<double>(pixels) / most_pixels_per_byte > static_cast<double>(bytes))
        throw InputError(name, "says " + std::to_string(spec.width) + " x " +
                                   std::to_string(spec.height) + " pixels, but has " +
                                   std::to_string(bytes) + " bytes; accepted: one byte for " +
                                   std::to_string(most_pixels_per_byte) + " pixels at least");
}

/// Decoded value of every integer of a type.
template <class Integer>
std::vector<float> decoding_table(ImageUse use) {
    constexpr int last = std::numeric_limits<Integer>::max();
    std::vector<float> table(std::size_t{last} + 1);
    for (int i = 0; i <= last; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(last);
        table[static_cast<std::size_t>(i)] =
            use == ImageUse::numbers ? share : linear_from_srgb(share);
    }
    return table;
}

class Decoder {
public:
    Decoder(OIIO::ImageInput& image, const std::string& name, ImageUse use, std::uintmax_t bytes)
        : image_(image), spec_(image.spec()), name_(name), use_(use), bytes_(bytes) {}

    TextureImage read() {
        check_size(spec_, name_, bytes_);
        channels_ = find_channels(spec_, name_);
        result_.texture.name = name_;
        result_.texture.width = spec_.width;
        result_.texture.height = spec_.height;
        const auto texels = static_cast<std::size_t>(spec_.image_pixels());
        result_.texture.texels.resize(texels);
        if (channels_.alpha >= 0) result_.alpha.resize(texels);
        if (spec_.format == OIIO::TypeDesc::UINT8) {
            decode_integers<std::uint8_t>(OIIO::TypeDesc::UINT8);
        } else if (!spec_.format.is_floating_point()) {
            decode_integers<std::uint16_t>(OIIO::TypeDesc::UINT16);
        } else {
            decode<float>(
                OIIO::TypeDesc::FLOAT, [](float v) { return v; }, [](float v) { return v; });
            // These formats hold colours with alpha multiplied in.
            if (std::string_view(image_.format_name()) == "openexr") divide_by_alpha();
        }
        return std::move(result_);
    }

private:
    template <class Integer>
    void decode_integers(OIIO::TypeDesc type) {
        const std::vector<float> table = decoding_table<Integer>(use_);
        constexpr auto most = static_cast<float>(std::numeric_limits<Integer>::max());
        decode<Integer>(
            type, [&](Integer v) { return table[v]; },
            [&](Integer v) { return static_cast<float>(v) / most; });
    }

    template <class Stored, class DecodeColour, class DecodeAlpha>
    void decode(OIIO::TypeDesc type, DecodeColour decode_colour, DecodeAlpha decode_alpha) {
        const auto stride = static_cast<std::size_t>(spec_.nchannels);
        std::vector<Stored> values(result_.texture.texels.size() * stride);
        if (!image_.read_image(0, 0, 0, spec_.nchannels, type, values.data()) || image_.has_error())
            throw InputError(name_, "cannot be read as an image: " + first_line(image_.geterror()));
        for (std::size_t t = 0; t < result_.texture.texels.size(); ++t) {
            const Stored* at = values.data() + t * stride;
            for (int c = 0; c < channel_count; ++c)
                result_.texture.texels[t][c] =
                    decode_colour(at[channels_.colour[static_cast<std::size_t>(c)]]);
            if (channels_.alpha >= 0) result_.alpha[t] = decode_alpha(at[channels_.alpha]);
        }
    }

    void divide_by_alpha() {
        for (std::size_t t = 0; t < result_.alpha.size(); ++t)
            if (result_.alpha[t] > 0.0f && result_.alpha[t] < 1.0f)
                result_.texture.texels[t] /= result_.alpha[t];
    }

    OIIO::ImageInput& image_;
    const OIIO::ImageSpec spec_;
    const std::string& name_;
    ImageUse use_;
    std::uintmax_t bytes_;  ///< of its file
    Channels channels_;
    TextureImage result_;
};

/// Puts a value right; says whether it was wrong.
bool mend(float& value, float most, bool& was_finite) {
    was_finite = std::isfinite(value);
    const float mended = was_finite ? std::clamp(value, 0.0f, most) : 0.0f;
    return std::exchange(value, mended) != mended;
}

void mend_values(TextureImage& image, ImageUse use, const std::string& name, Monitor& monitor) {
    const float most = use == ImageUse::emission ? std::numeric_limits<float>::max() : 1.0f;
    std::size_t not_finite = 0, outside = 0;
    const auto mend_all = [&](float* values, int count, float limit) {
        bool any_not_finite = false, any_outside = false;
        for (int i = 0; i < count; ++i) {
            bool was_finite = true;
            if (!mend(values[i], limit, was_finite)) continue;
            (was_finite ? any_outside : any_not_finite) = true;
        }
        not_finite += any_not_finite;
        outside += any_outside;
    };
    for (Spectrum& texel : image.texture.texels) mend_all(&texel.x, channel_count, most);
    for (float& alpha : image.alpha) mend_all(&alpha, 1, 1.0f);
    const std::string of_all = " of " + std::to_string(image.texture.texels.size()) + " texels ";
    if (not_finite > 0)
        monitor.warn(name + ": " + std::to_string(not_finite) + of_all +
                     "hold a value that is not finite; 0 is taken");
    if (outside > 0)
        monitor.warn(name + ": " + std::to_string(outside) + of_all + "hold a value " +
                     (use == ImageUse::emission ? "below 0" : "outside [0, 1]") +
                     "; it is clamped");
}

}  // namespace

TextureImage read_texture(const std::string& name, ImageUse use, Monitor& monitor,
                          std::string_view bytes) {
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
    std::error_code unknown;
    const std::uintmax_t size =
        bytes.empty() ? std::filesystem::file_size(name, unknown) : std::uintmax_t{bytes.size()};
    TextureImage result = Decoder(*image, name, use, size).read();
    mend_values(result, use, name, monitor);
    return result;
}

}  // namespace transillum
