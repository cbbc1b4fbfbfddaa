#include "benchmarks/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace transillum::benchmarks {

namespace {

/// 97.5 % quantiles by degrees of freedom, from 1 on.
double student(std::size_t freedom) {
    constexpr std::array<double, 20> quantiles{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365,
                                               2.306,  2.262, 2.228, 2.201, 2.179, 2.160, 2.145,
                                               2.131,  2.120, 2.110, 2.101, 2.093, 2.086};
    return freedom <= quantiles.size() ? quantiles[freedom - 1] : 1.96;
}

double mean_square(std::span<const double> values) {
    double sum = 0.0;
    for (const double v : values) sum += v * v;
    return sum / static_cast<double>(values.size());
}

/// \param from_mean how far every run is from their mean; \param of_mean how far that is from the
/// truth
SeedErrors divide(std::span<const double> errors, std::span<const double> from_mean,
                  double of_mean) {
    const auto n = static_cast<double>(errors.size());
    SeedErrors result;
    result.error = band_of(errors);
    if (errors.size() < 2) {
        result.bias = result.spread = std::numeric_limits<double>::quiet_NaN();
        return result;
    }
    const double variance = mean_square(from_mean) * n / (n - 1.0);
    result.spread = std::sqrt(variance);
    result.bias = std::sqrt(std::max(0.0, of_mean * of_mean - variance / n));
    return result;
}

Image mean_of(const std::vector<Image>& images) {
    Image mean = images.front();
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
        SpectrumSum sum(0.0);
        for (const Image& image : images) {
            sum += SpectrumSum(image.pixels[i]);
            if (!image.emitter_mask.empty())
                mean.emitter_mask[i] = std::max(mean.emitter_mask[i], image.emitter_mask[i]);
        }
        mean.pixels[i] = Spectrum(sum / static_cast<double>(images.size()));
    }
    return mean;
}

}  // namespace

Band band_of(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    Band band;
    for (const double v : values) band.mean += v / n;
    if (values.size() < 2) {
        band.low = band.high = std::numeric_limits<double>::quiet_NaN();
        return band;
    }
    double square = 0.0;
    for (const double v : values) square += (v - band.mean) * (v - band.mean);
    const double half = student(values.size() - 1) * std::sqrt(square / (n - 1.0) / n);
    band.low = std::max(0.0, band.mean - half);
    band.high = band.mean + half;
    return band;
}

ImageTruth truth_of(Image one, const Image& other) {
    ImageTruth truth;
    truth.noise = 0.5 * compare_images(one, other).relative_rmse;
    for (std::size_t i = 0; i < one.pixels.size(); ++i)
        one.pixels[i] = 0.5f * (one.pixels[i] + other.pixels[i]);
    truth.image = std::move(one);
    return truth;
}

SeedErrors image_errors(const std::vector<Image>& runs, const ImageTruth& truth) {
    const auto from_truth = [&](const Image& image) {
        const double all = compare_images(image, truth.image).relative_rmse;
        return std::sqrt(std::max(0.0, all * all - truth.noise * truth.noise));
    };
    const Image mean = mean_of(runs);
    std::vector<double> errors, from_mean;
    for (const Image& image : runs) {
        errors.push_back(from_truth(image));
        from_mean.push_back(compare_images(image, mean).relative_rmse);
    }
    return divide(errors, from_mean, from_truth(mean));
}

LeafField irradiance_of(const Solution& s, bool indirect) {
    LeafField field;
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        SpectrumSum e(s.indirect_irradiance[p]);
        if (!indirect) e += SpectrumSum(s.direct_irradiance[p]);
        field.values.push_back(luminance(e));
        const bool counts = s.reflects(p) && s.coverage[p] > 0.0f;
        field.weights.push_back(
            counts ? area_of_leaf(s.surface, s.patches, s.patches.leaf_of_patch(p)) : 0.0);
    }
    return field;
}

double relative_rms(std::span<const double> values, const LeafField& truth) {
    double area = 0.0, mean = 0.0, square = 0.0;
    for (std::size_t p = 0; p < values.size(); ++p) {
        const double w = truth.weights[p];
        area += w;
        mean += w * truth.values[p];
        square += w * (values[p] - truth.values[p]) * (values[p] - truth.values[p]);
    }
    return std::sqrt(square * area) / mean;
}

SeedErrors leaf_errors(const std::vector<std::vector<double>>& runs, const LeafField& truth) {
    LeafField mean = truth;
    for (std::size_t p = 0; p < mean.values.size(); ++p) {
        mean.values[p] = 0.0;
        for (const auto& run : runs) mean.values[p] += run[p] / static_cast<double>(runs.size());
    }
    std::vector<double> errors, from_mean;
    for (const auto& run : runs) {
        errors.push_back(relative_rms(run, truth));
        from_mean.push_back(relative_rms(run, mean));
    }
    return divide(errors, from_mean, relative_rms(mean.values, truth));
}

}  // namespace transillum::benchmarks
