#include <transillum/base/sampling.h>
#include <transillum/transport/direction_bins.h>

#include <cmath>
#include <numbers>

namespace transillum {

namespace {

constexpr float quarter_pi = std::numbers::pi_v<float> / 4.0f;

/// The one normal about which frames turn fast lies opposite to this direction, far from the axes
/// that walls and floors have.
const glm::dvec3 calm(0.435, 0.577, 0.691);

/// Continuous but for n = (0, 0, -1) (Duff et al. 2017).
glm::dmat3 frame_off_pole(const glm::dvec3& n) {
    const double a = -1.0 / std::max(1.0 + n.z, 1e-12), b = n.x * n.y * a;
    const glm::dvec3 u = glm::normalize(glm::dvec3(1.0 + n.x * n.x * a, b, -n.x));
    return {u, glm::cross(n, u), n};
}

}  // namespace

glm::vec2 square_of_direction(const glm::vec3& d) {
    const float radius = std::min(std::sqrt(d.x * d.x + d.y * d.y), 1.0f);
    if (radius == 0.0f) return {0.5f, 0.5f};
    // The disk's quarter about an axis becomes the square's triangle about it.
    const bool along_x = std::abs(d.x) >= std::abs(d.y);
    const float major = along_x ? d.x : d.y, minor = along_x ? d.y : d.x;
    const float a = std::copysign(radius, major);
    const float b = a * std::atan(minor / major) / quarter_pi;
    return 0.5f * (along_x ? glm::vec2(a, b) : glm::vec2(b, a)) + 0.5f;
}

glm::vec3 direction_of_square(const glm::vec2& square) {
    const glm::vec2 p = 2.0f * square - 1.0f;
    const bool along_x = std::abs(p.x) >= std::abs(p.y);
    const float major = along_x ? p.x : p.y, minor = along_x ? p.y : p.x;
    if (major == 0.0f) return {0.0f, 0.0f, 1.0f};
    const float angle = quarter_pi * minor / major;
    const float a = major * std::cos(angle), b = major * std::sin(angle);
    const float z = std::sqrt(std::max(0.0f, 1.0f - major * major));
    return along_x ? glm::vec3(a, b, z) : glm::vec3(b, a, z);
}

glm::dmat3 bin_frame(const glm::dvec3& normal) {
    const glm::dmat3 from_calm = frame_about(glm::normalize(calm));
    return from_calm * frame_off_pole(normal * from_calm);
}

}  // namespace transillum
