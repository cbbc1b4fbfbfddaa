/// Light from outside the scene: none, uniform, a lat-long image, or a CIE sky.
#pragma once

#include <transillum/base/spectrum.h>
#include <transillum/scene/texture.h>

#include <cstdint>
#include <memory>

namespace transillum {

struct Environment {
    enum class Kind : std::uint8_t { none, uniform, image, overcast, clear };
    Kind kind = Kind::none;
    Spectrum radiance_scale{
        1.0f};                     ///< uniform: the radiance; image: a factor; skies: at the zenith
    glm::dvec3 up{0.0, 1.0, 0.0};  ///< unit: the zenith, the top of the image
    double rotation = 0.0;         ///< of the image about `up` [radians]
    glm::dvec3 sun{0.0, 1.0, 0.0};         ///< unit, towards the sun: clear sky
    std::shared_ptr<const Texture> image;  ///< lat-long, top row at the zenith

    [[nodiscard]] bool shines() const { return kind != Kind::none; }
    /// Radiance [W sr^-1 m^-2] that comes from a unit direction (pointing away from the scene).
    [[nodiscard]] Spectrum radiance(const glm::dvec3& from) const;
};

}  // namespace transillum
