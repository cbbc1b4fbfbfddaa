/// From linear radiance to what a screen shows.
#pragma once

#include <transillum/base/srgb.h>
#include <transillum/render/image.h>

namespace transillum {

/// The factor that ToneMapping asks for with this image. Pixels that see an emitter, and black
/// ones, have no say in automatic exposure unless there are no others.
[[nodiscard]] float exposure_factor(const Image& image, const ToneMapping& tone);

/// Exposed linear colour to linear display colour in [0, 1]: proportional up to a shoulder.
/// Channels keep their ratios, so hues stay.
[[nodiscard]] Spectrum compress_highlights(const Spectrum& colour);

}  // namespace transillum
