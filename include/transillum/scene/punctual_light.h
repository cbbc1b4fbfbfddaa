/// Lights without extent: glTF's KHR_lights_punctual, and photometric data (IES LM-63) on points.
#pragma once

#include <transillum/base/spectrum.h>

#include <cstdint>
#include <memory>
#include <string>

namespace transillum {

struct Photometry;

struct PunctualLight {
    enum class Kind : std::uint8_t { point, spot, directional };
    std::string name;
    Kind kind = Kind::point;
    glm::dvec3 position{0.0};              ///< point, spot
    glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit, the way light travels; spot: its axis
    glm::dvec3 up{0.0, 1.0, 0.0};  ///< where C = 90 degrees of the photometry lies, across the axis
    /// Point and spot: radiant intensity on the axis [W sr^-1]; with photometry: its scale.
    /// Directional: irradiance of a surface that faces it [W m^-2].
    Spectrum intensity{1.0f};
    double inner_angle = 0.0, outer_angle = 0.785398163397448;  ///< spot: half-angles [radians]
    std::shared_ptr<const Photometry> photometry;               ///< point: where the IES file says

    /// Radiant intensity [W sr^-1] of a point or spot towards a unit direction.
    [[nodiscard]] Spectrum intensity_towards(const glm::dvec3& direction) const;
};

}  // namespace transillum
