#include <transillum/base/error.h>
#include <transillum/render/render_solution.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace transillum {

namespace {

/// From the front, +z, with +y up: glTF's convention.
Camera framing_camera(const SurfaceMesh& surface) {
    Camera camera;
    camera.name = "frame";
    if (surface.positions.empty()) return camera;
    glm::dvec3 low = surface.positions.front(), high = low;
    for (const glm::dvec3& p : surface.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double radius = 0.5 * glm::length(high - low);
    camera.look_at = 0.5 * (low + high);
    camera.eye = camera.look_at;
    camera.eye.z += radius / std::sin(camera.vertical_fov * std::numbers::pi / 360.0);
    return camera;
}

}  // namespace

Camera choose_camera(const std::vector<Camera>& cameras, const SurfaceMesh& surface,
                     const std::string& name) {
    for (const Camera& camera : cameras)
        if (name.empty() || camera.name == name) return camera;
    if (name.empty()) return framing_camera(surface);
    std::string known;
    for (const Camera& camera : cameras) known += (known.empty() ? "'" : ", '") + camera.name + "'";
    throw UsageError("camera '" + name + "' is unknown; accepted: " +
                     (known.empty() ? std::string("none, there are no cameras") : known));
}

}  // namespace transillum
