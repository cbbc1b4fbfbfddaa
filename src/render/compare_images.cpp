#include <transillum/base/error.h>
#include <transillum/render/image.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace transillum {

namespace {

std::string size_of(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

void check_finite(const Image& image, const char* which) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (!is_finite(image.pixels[i]))
            throw InputError(which, "pixel (" + std::to_string(i % image.width) + ", " +
                                        std::to_string(i / image.width) +
                                        ") is not finite; accepted: finite values");
}

/// Marks the pixels that see an emitter, and their neighbours.
void mark_emitters(const Image& image, std::vector<char>& marks) {
    if (image.emitter_mask.empty()) return;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (!(image.emitter_mask[static_cast<std::size_t>(y) * image.width + x] > 0.0f))
                continue;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u)
                    marks[static_cast<std::size_t>(v) * image.width + u] = 1;
        }
}

/// Relative to the reference's mean; where that is black, only black is no difference.
double relative(double difference, double mean) {
    if (difference == 0.0) return 0.0;
    return mean > 0.0 ? difference / mean
                      : std::copysign(std::numeric_limits<double>::infinity(), difference);
}

}  // namespace

ImageDifference compare_images(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw InputError("images",
                         "sizes " + size_of(a) + " and " + size_of(b) + "; accepted: equal sizes");
    check_finite(a, "first image");
    check_finite(b, "second image");
    std::vector<char> left_out(a.pixels.size(), 0);
    mark_emitters(a, left_out);
    mark_emitters(b, left_out);

    ImageDifference result;
    double sum_b = 0.0, sum = 0.0, sum_squares = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        if (left_out[i]) {
            ++result.left_out;
            continue;
        }
        ++result.compared;
        const double of_b = luminance(SpectrumSum(b.pixels[i]));
        const double difference = luminance(SpectrumSum(a.pixels[i])) - of_b;
        sum_b += of_b;
        sum += difference;
        sum_squares += difference * difference;
        largest = std::max(largest, std::abs(difference));
    }
    if (result.compared == 0)
        throw InputError(
            "images", "every pixel sees an emitter or adjoins one that does; nothing to compare");
    const auto n = static_cast<double>(result.compared);
    result.bias = relative(sum / n, sum_b / n);
    result.relative_rmse = relative(std::sqrt(sum_squares / n), sum_b / n);
    result.largest = relative(largest, sum_b / n);
    return result;
}

}  // namespace transillum
