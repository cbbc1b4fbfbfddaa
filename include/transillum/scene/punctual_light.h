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
    /// Where C = 90 degrees of the photometry lies, across the axis; -z where it is along the axis.
    glm::dvec3 up{0.0, 1.0, 0.0};
    /// Point and spot: radiant intensity on the axis [W sr^-1]; with photometry: its scale.
    /// Directional: irradiance of a surface that faces it [W m^-2].
    Spectrum intensity{1.0f};
    double inner_angle = 0.0, outer_angle = 0.785398163397448;  ///< spot: half-angles [radians]
    std::shared_ptr<const Photometry> photometry;               ///< point: where the IES file says

    /// How a point or spot spreads its intensity: intensity_towards / intensity. Point: 1; spot:
    /// the falloff between its angles, 1 within the inner; with photometry: candela.
    [[nodiscard]] double distribution(const glm::dvec3& direction) const;
    /// Radiant intensity [W sr^-1] of a point or spot towards a unit direction.
    [[nodiscard]] Spectrum intensity_towards(const glm::dvec3& direction) const;
    /// Flux that a point or spot sends out [W]; 0 of a directional light.
    [[nodiscard]] SpectrumSum flux() const;
};

}  // namespace transillum
