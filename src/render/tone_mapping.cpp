#include "render/tone_mapping.h"

#include <algorithm>
#include <cmath>

namespace transillum {

namespace {

constexpr float middle_grey = 0.18f;
constexpr float shoulder = 0.6f;

template <class Accept>
float median_luminance(std::span<const Spectrum> radiance, Accept accept) {
    std::vector<float> lit;
    for (std::size_t i = 0; i < radiance.size(); ++i)
        if (const float y = luminance(radiance[i]); y > 0.0f && accept(i)) lit.push_back(y);
    if (lit.empty()) return 0.0f;
    const auto middle = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() / 2);
    std::nth_element(lit.begin(), middle, lit.end());
    return *middle;
}

}  // namespace

float exposure_factor(std::span<const Spectrum> radiance, std::span<const float> emitter_mask,
                      const ToneMapping& tone) {
    const auto stops = static_cast<float>(std::exp2(tone.exposure));
    if (!tone.automatic) return stops;
    float median = median_luminance(
        radiance, [&](std::size_t i) { return emitter_mask.empty() || emitter_mask[i] == 0.0f; });
    if (median == 0.0f) median = median_luminance(radiance, [](std::size_t) { return true; });
    return median > 0.0f ? stops * middle_grey / median : stops;
}

float surface_exposure_factor(std::span<const Spectrum> radiance,
                              std::span<const float> emitter_mask, const ToneMapping& tone) {
    constexpr double dark = 0.01;  // of the mean
    std::vector<float> mask(emitter_mask.begin(), emitter_mask.end());
    mask.resize(radiance.size(), 0.0f);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < radiance.size(); ++i)
        if (mask[i] == 0.0f) {
            sum += luminance(radiance[i]);
            count += 1.0;
        }
    for (std::size_t i = 0; i < radiance.size(); ++i)
        if (luminance(radiance[i]) * count < dark * sum) mask[i] = 1.0f;
    return exposure_factor(radiance, mask, tone);
}

double automatic_exposure(const Image& image) {
    return std::log2(double{exposure_factor(image, {})});
}

Spectrum display_colour(const Spectrum& radiance, double stops) {
    return compress_highlights(static_cast<float>(std::exp2(stops)) * radiance);
}

Spectrum compress_highlights(const Spectrum& colour) {
    const Spectrum c = glm::max(colour, Spectrum(0.0f));
    const float peak = max_channel(c);
    if (peak <= shoulder) return c;
    const float range = 1.0f - shoulder;
    return c * ((1.0f - range * std::exp((shoulder - peak) / range)) / peak);
}

}  // namespace transillum
