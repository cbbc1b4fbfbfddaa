/// Images in memory and on disk (OpenImageIO).
#pragma once

#include <transillum/base/spectrum.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace transillum {

/// Row-major from the top left; linear radiance [W sr^-1 m^-2].
struct Image {
    int width = 0, height = 0;
    std::vector<Spectrum> pixels;
    /// Optional, one a pixel: share of its samples that see an emitter; above 0 it counts as seeing
    /// one. Stored as the EXR channel "emitter.mask".
    std::vector<float> emitter_mask;

    [[nodiscard]] Spectrum& at(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * width + x];
    }
    [[nodiscard]] const Spectrum& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * width + x];
    }
};

/// How linear radiance becomes an 8-bit picture: scaled by 2^exposure, then a filmic shoulder that
/// leaves mid-tones linear, then the sRGB curve.
struct ToneMapping {
    double exposure = 0.0;  ///< [stops], relative to automatic exposure where that is on
    bool automatic =
        true;  ///< scale so that the median luminance of lit pixels shows as middle grey
};

/// What a screen shows of a radiance that is exposed by so many stops: linear sRGB in [0, 1].
[[nodiscard]] Spectrum display_colour(const Spectrum& radiance, double stops);

/// The exposure [stops] that automatic exposure chooses for an image.
[[nodiscard]] double automatic_exposure(const Image& image);

/// Writes EXR (32-bit float, linear, no loss) or PNG (tone-mapped) by the extension; atomically.
/// \throws UsageError for another extension, InputError where a pixel is not finite, IoError where
/// it cannot write; nothing is left behind then.
void write_image(const Image& image, const std::filesystem::path& path,
                 const ToneMapping& tone = {});

/// What write_image() would write as .png. \throws as it
[[nodiscard]] std::string png_bytes(const Image& image, const ToneMapping& tone = {});

/// Reads what OpenImageIO reads; PNG and other 8-bit images are taken as sRGB and made linear.
/// \throws IoError, InputError.
[[nodiscard]] Image read_image(const std::filesystem::path& path);

struct ImageDifference {
    double bias = 0.0;  ///< (mean luminance of a - of b) / mean luminance of b
    double relative_rmse =
        0.0;               ///< root mean square of the luminance difference / mean luminance of b
    double largest = 0.0;  ///< largest |difference| / mean luminance of b
    std::uint64_t compared = 0;  ///< pixels
    std::uint64_t left_out =
        0;  ///< pixels that see an emitter, and their neighbours, in either image
};

/// a against the reference b. \throws InputError when sizes differ, a value is not finite, or no
/// pixel is left.
[[nodiscard]] ImageDifference compare_images(const Image& a, const Image& b);

}  // namespace transillum
