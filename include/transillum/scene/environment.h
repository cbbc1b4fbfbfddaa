/// Light from outside the scene: none, uniform, a lat-long image, or a CIE sky.
///
/// Azimuths run clockwise seen from above, from north: where `up` is +z, north is +y and east +x;
/// where it is +y, north is -z and east +x; for another zenith these turn with it the shortest way.
///
///   image     left edge at the azimuth `rotation`, azimuth growing to the right, top row at the
///             zenith (so for +y up the middle looks along +z, as OpenEXR's lat-long maps do);
///             bilinear between texel centres
///   overcast  CIE standard overcast sky (Moon and Spencer): L = Lz (1 + 2 sin gamma) / 3
///   clear     CIE standard clear sky (CIE S 003, Kittler), without the sun itself:
///             L = Lz f(chi) p(gamma) / (f(pi / 2 - gamma_sun) p(pi / 2)),
///             f(chi) = 0.91 + 10 exp(-3 chi) + 0.45 cos^2 chi, p(gamma) = 1 - exp(-0.32 / sin
///             gamma)
///
/// gamma is the elevation of a direction, chi its angle to the sun, Lz the radiance at the zenith.
/// Below the horizon the skies are black.
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
    double rotation = 0.0;         ///< of the image about `up`, clockwise from above [radians]
    glm::dvec3 sun{0.0, 1.0, 0.0};         ///< unit, towards the sun: clear sky
    std::shared_ptr<const Texture> image;  ///< lat-long, top row at the zenith

    [[nodiscard]] bool shines() const { return kind != Kind::none; }
    /// Radiance [W sr^-1 m^-2] that comes from a unit direction (pointing away from the scene).
    [[nodiscard]] Spectrum radiance(const glm::dvec3& from) const;
};

/// The unit direction at an azimuth and an elevation above the horizon [radians].
[[nodiscard]] glm::dvec3 sky_direction(const glm::dvec3& up, double azimuth, double elevation);

/// Solid angle [sr] that a texel of a row stands for in a lat-long image: the integral of its share
/// in bilinear interpolation. Over the whole image they make up 4 pi.
[[nodiscard]] double texel_solid_angle(const Texture& lat_long, int row);

}  // namespace transillum
