#include <transillum/scene/photometry.h>
#include <transillum/scene/punctual_light.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

/// KHR_lights_punctual, "Inner and Outer Cone Angles": between them the square of what is linear in
/// the cosine.
struct Cone {
    double outer, width;  ///< cosine where light begins, and over how much it becomes full
    explicit Cone(const PunctualLight& light)
        : outer(std::cos(light.outer_angle)),
          width(std::max(0.001, std::cos(light.inner_angle) - outer)) {}
    [[nodiscard]] double falloff(double cosine) const {
        const double share = std::clamp((cosine - outer) / width, 0.0, 1.0);
        return share * share;
    }
    /// Over the sphere.
    [[nodiscard]] double integral() const {
        const double edge = std::min(width, 1.0 - outer), share = edge / width;
        return 2.0 * std::numbers::pi * (share * share * edge / 3.0 + 1.0 - outer - edge);
    }
};

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
    return kind == Kind::spot ? Cone(*this).falloff(glm::dot(direction, towards)) : 1.0;
}

SpectrumSum PunctualLight::flux() const {
    if (kind == Kind::directional) return SpectrumSum(0.0);
    const double integral = photometry           ? photometry->flux()
                            : kind == Kind::spot ? Cone(*this).integral()
                                                 : 4.0 * std::numbers::pi;
    return integral * SpectrumSum(intensity);
}

Spectrum PunctualLight::intensity_towards(const glm::dvec3& towards) const {
    return intensity * static_cast<float>(distribution(towards));
}

}  // namespace transillum
