/// Suns in an environment image.
#pragma once

#include <transillum/scene/environment.h>
#include <transillum/scene/punctual_light.h>

#include <numbers>
#include <vector>

namespace transillum {

struct SunOptions {
    double brightness = 10.0;   ///< times the image's mean, from which a texel may be of a sun
    double least_share = 0.01;  ///< of the image's whole that a sun brings at least
    /// Most a sun may extend over [sr]: what one of a thousand directions stands for.
    double most_solid_angle = 4.0 * std::numbers::pi / 1000.0;
};

struct Suns {
    std::vector<PunctualLight> lights;  ///< directional, named "sun 1", ...
    SpectrumSum moved{0.0};             ///< their irradiances, summed [W m^-2]
    double share = 0.0;                 ///< of the image's integral over all directions
};

/// Moves what shines from few texels of an image to directional lights, so that some thousand
/// directions integrate what is left. Texels (mean of the channels) brighter than `brightness`
/// times the image's mean that touch form a region. A region that is small enough, and of which
/// what exceeds the threshold is share enough, becomes a light: its texels are scaled down to the
/// threshold, keeping their colour. Of a region that is too large the same is tried with the
/// threshold doubled, until nothing exceeds it. Any surface that sees a whole region gets the same
/// irradiance from the light as it got from what was taken away. Other kinds are left as they are.
[[nodiscard]] Suns split_sun(Environment& environment, const SunOptions& options = {});

}  // namespace transillum
