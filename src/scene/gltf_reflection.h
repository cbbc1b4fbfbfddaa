/// Metallic-roughness (glTF 2.0, appendix B) as the reflectances of a Material.
#pragma once

#include <transillum/base/spectrum.h>

#include <glm/common.hpp>

namespace transillum {

/// What a point of a glTF material reflects.
/// \param dielectric reflectance at normal incidence where it is no metal
struct GltfReflection {
    Spectrum dielectric{0.04f};
    [[nodiscard]] static Spectrum diffuse(const Spectrum& base, float metallic) {
        return base * (1.0f - metallic);
    }
    [[nodiscard]] Spectrum specular(const Spectrum& base, float metallic) const {
        return glm::mix(dielectric, base, metallic);
    }
};

}  // namespace transillum
