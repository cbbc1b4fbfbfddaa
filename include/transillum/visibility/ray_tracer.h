/// Rays against the root triangles (Embree). For the eye, for shadow rays when rendering, and for
/// the reference; the bake's transport has its own buffers.
#pragma once

#include <transillum/geometry/surface_mesh.h>

#include <cstdint>
#include <limits>
#include <memory>

namespace transillum {

struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, 1.0};  ///< unit
    float min_distance = 0.0f;
    float max_distance = std::numeric_limits<float>::infinity();
};

struct Hit {
    static constexpr std::uint32_t none = 0xffffffffu;
    std::uint32_t root = none;
    float b1 = 0.0f, b2 = 0.0f;  ///< barycentric coordinates of the root's second and third vertex
    float distance = 0.0f;
    bool back = false;  ///< the back was met
    explicit operator bool() const { return root != none; }
};

/// Immutable once built; calls are thread-safe. Watertight (Embree's robust mode).
class RayTracer {
public:
    /// Keeps no reference to the mesh.
    explicit RayTracer(const SurfaceMesh& mesh);
    ~RayTracer();
    RayTracer(RayTracer&&) noexcept;
    RayTracer& operator=(RayTracer&&) noexcept;

    [[nodiscard]] Hit intersect(const Ray& ray) const;
    /// Is anything between two points? Both ends are kept clear of the surfaces they lie on, on the
    /// side of the other end. Normals are unit, of either sign; zero for a point in free space.
    [[nodiscard]] bool occluded(const glm::dvec3& from, const glm::dvec3& from_normal,
                                const glm::dvec3& to, const glm::dvec3& to_normal) const;
    /// How far a ray's origin is to be moved along the normal to clear the surface: proportional to
    /// the rounding of single-precision coordinates at that distance from the scene's centre,
    /// within the scene at that of its bounds (a large triangle's plane is as inexact as its
    /// corners).
    [[nodiscard]] double clearance(const glm::dvec3& point) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace transillum
