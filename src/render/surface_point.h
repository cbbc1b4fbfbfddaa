/// A point of a solution's surface as an eye sees it.
#pragma once

#include <transillum/scene/brdf.h>
#include <transillum/transport/glossy_sides.h>

#include <glm/mat3x3.hpp>

#include <cstdint>

namespace transillum {

struct SurfacePoint {
    std::uint32_t leaf = 0, patch = 0;
    glm::vec3 within{1.0f, 0.0f, 0.0f};  ///< barycentric coordinates of the leaf's corners
    glm::dvec3 position{0.0}, normal{0.0, 0.0, 1.0};  ///< of the side that is seen
    Brdf brdf;                                        ///< textures at this very point
    const GlossySide* side = nullptr;                 ///< null where it has no lobe
    glm::mat3 world_from_local{1.0f};                 ///< its z is the normal
    // Where the BRDF has a lobe at this point, that is the frame its bins lie in, and:
    glm::vec3 out{0.0f, 0.0f, 1.0f};  ///< unit, to the eye, local
    bool is_sharp = false;            ///< its lobe is to be followed by rays: no bin resolves it

    [[nodiscard]] bool has_lobe() const { return brdf.lobe != Lobe::none; }
    [[nodiscard]] glm::vec3 local(const glm::dvec3& direction) const {
        return glm::vec3(direction) * world_from_local;
    }
    [[nodiscard]] glm::dvec3 world(const glm::vec3& direction) const {
        return glm::normalize(glm::dvec3(world_from_local * direction));
    }
    /// The lobe alone.
    [[nodiscard]] Brdf lobe() const {
        Brdf lobe = brdf;
        lobe.diffuse = Spectrum(0.0f);
        return lobe;
    }
};

}  // namespace transillum
