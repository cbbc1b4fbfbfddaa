#include "render/camera_rays.h"

#include <transillum/base/error.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace transillum {

namespace {

constexpr int largest_size = 65536;

void check_size(const char* what, int size) {
    if (size < 1 || size > largest_size)
        throw UsageError(std::string("image ") + what + ": " + std::to_string(size) +
                         "; accepted: 1 to " + std::to_string(largest_size));
}

void check_frame(const Camera& camera, const glm::dvec3& forward, const glm::dvec3& right) {
    const std::string who = "camera '" + camera.name + "': ";
    if (!(camera.vertical_fov > 0.0 && camera.vertical_fov < 180.0))
        throw UsageError(who + "field of view " + std::to_string(camera.vertical_fov) +
                         " degrees; accepted: above 0 and below 180");
    if (!std::isfinite(glm::length(forward)) || glm::length(forward) == 0.0)
        throw UsageError(who + "it looks at its own eye; accepted: two different, finite points");
    const double straight = 1e-9 * glm::length(forward) * glm::length(camera.up);
    if (!(glm::length(right) > straight))
        throw UsageError(who + "up is parallel to the view; accepted: any other direction");
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, int width, int height) : eye_(camera.eye) {
    check_size("width", width);
    check_size("height", height);
    const glm::dvec3 forward = camera.look_at - camera.eye;
    const glm::dvec3 across = glm::cross(forward, camera.up);
    check_frame(camera, forward, across);
    const double half_height = std::tan(camera.vertical_fov * std::numbers::pi / 360.0);
    const double pixel = 2.0 * half_height / height;
    right_ = pixel * glm::normalize(across);
    down_ = -pixel * glm::normalize(glm::cross(across, forward));
    corner_ = glm::normalize(forward) - 0.5 * width * right_ - 0.5 * height * down_;
}

glm::dvec3 CameraRays::direction(double x, double y) const {
    return glm::normalize(corner_ + x * right_ + y * down_);
}

}  // namespace transillum
