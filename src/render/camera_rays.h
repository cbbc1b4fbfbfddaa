/// A pinhole camera's rays through an image.
#pragma once

#include <transillum/scene/scene.h>

#include <glm/vec3.hpp>

namespace transillum {

class CameraRays {
public:
    /// \throws UsageError for an image size outside [1, 65536], a field of view outside (0, 180),
    /// or an eye and directions that span no frame.
    CameraRays(const Camera& camera, int width, int height);

    [[nodiscard]] const glm::dvec3& eye() const { return eye_; }
    /// Unit direction through a point of the image; in pixels, from its top left corner.
    [[nodiscard]] glm::dvec3 direction(double x, double y) const;

private:
    glm::dvec3 eye_;
    glm::dvec3 corner_, right_,
        down_;  ///< of the image, one unit before the eye; steps of one pixel
};

}  // namespace transillum
