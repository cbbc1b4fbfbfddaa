/// From linear radiance to what a screen shows.
#pragma once

#include <transillum/base/srgb.h>
#include <transillum/render/image.h>

#include <span>

namespace transillum {

/// The factor that ToneMapping asks for with these radiances. Those of emitters, and black ones,
/// have no say in automatic exposure unless there are no others.
/// \param emitter_mask above 0: of an emitter; one a radiance, or empty
[[nodiscard]] float exposure_factor(std::span<const Spectrum> radiance,
                                    std::span<const float> emitter_mask, const ToneMapping& tone);
[[nodiscard]] inline float exposure_factor(const Image& image, const ToneMapping& tone) {
    return exposure_factor(image.pixels, image.emitter_mask, tone);
}

/// The same for radiance all over a surface, much of which no picture may show: what is darker than
/// a hundredth of the mean has no say either, as the insides of things that a trace of light gets
/// into.
[[nodiscard]] float surface_exposure_factor(std::span<const Spectrum> radiance,
                                            std::span<const float> emitter_mask,
                                            const ToneMapping& tone);

/// Exposed linear colour to linear display colour in [0, 1]: proportional up to a shoulder.
/// Channels keep their ratios, so hues stay.
[[nodiscard]] Spectrum compress_highlights(const Spectrum& colour);

}  // namespace transillum
