/// Direct light of small emitters, kept as incoming radiance (paper §4, "incoming first shot").
#pragma once

#include <transillum/base/spectrum.h>

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace transillum {

/// A point that stands for a piece of an emitter.
struct LightSample {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit; light leaves on this side
    double area = 0.0;                 ///< of the piece [square scene units]
    Spectrum radiance{0.0f};           ///< emitted [W sr^-1 m^-2]
    std::uint32_t root = 0;            ///< root triangle it lies on
    bool back = false;                 ///< it lies on that triangle's back
};

/// What arrives at the patches from the light samples. Row-major, one row a patch:
/// entry [patch * samples.size() + sample].
/// Irradiance of a patch = sum over samples of radiance * visibility * projected_solid_angle.
struct DirectLight {
    std::vector<LightSample> samples;  ///< empty where no emitter needs a first shot
    std::vector<float>
        projected_solid_angle;      ///< area * cos * cos' / r^2, patch mean, as if unoccluded [sr]
    std::vector<float> visibility;  ///< seen share of that [0, 1]
    /// Per root triangle and side (2 * root + back): its emission travels by first shot, so the
    /// iteration leaves it out.
    std::vector<std::uint8_t> shot_sides;
};

}  // namespace transillum
