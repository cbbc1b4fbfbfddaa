#include <transillum/scene/photometry.h>
#include <transillum/scene/punctual_light.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace transillum {

namespace {

/// KHR_lights_punctual, "Inner and Outer Cone Angles".
double spot_falloff(const PunctualLight& light, const glm::dvec3& direction) {
    const double inner = std::cos(light.inner_angle), outer = std::cos(light.outer_angle);
    const double scale = 1.0 / std::max(0.001, inner - outer);
    const double share =
        std::clamp((glm::dot(light.direction, direction) - outer) * scale, 0.0, 1.0);
    return share * share;
}

/// The nadir lies along the light's direction; seen from above, C grows counter-clockwise.
double photometric_intensity(const PunctualLight& light, const glm::dvec3& direction) {
    const glm::dvec3& nadir = light.direction;
    const double gamma = glm::degrees(
        std::atan2(glm::length(glm::cross(nadir, direction)), glm::dot(nadir, direction)));
    const bool is_along = glm::length(glm::cross(nadir, light.up)) < 1e-6 * glm::length(light.up);
    const glm::dvec3 up = is_along ? glm::dvec3(0, 0, -1) : light.up;
    const glm::dvec3 c0 = glm::cross(nadir, up), c90 = up - glm::dot(up, nadir) * nadir;
    const double c = glm::degrees(std::atan2(glm::dot(c90, direction), glm::dot(c0, direction)));
    return light.photometry->candela_at(c, gamma);
}

}  // namespace

double PunctualLight::distribution(const glm::dvec3& towards) const {
    if (photometry) return photometric_intensity(*this, towards);
    return kind == Kind::spot ? spot_falloff(*this, towards) : 1.0;
}

Spectrum PunctualLight::intensity_towards(const glm::dvec3& towards) const {
    return intensity * static_cast<float>(distribution(towards));
}

}  // namespace transillum
