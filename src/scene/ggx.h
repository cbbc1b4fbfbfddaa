/// The GGX lobe: D V F, with D of Trowbridge and Reitz 1975, V = G / (4 cos theta cos theta') of
/// height-correlated Smith shadowing (Heitz 2014), F of Schlick 1994. Directions are above the
/// surface.
#pragma once

#include <transillum/base/spectrum.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace transillum {

/// \param f0 reflectance at normal incidence
[[nodiscard]] Spectrum ggx_value(const Spectrum& f0, float alpha, const glm::vec3& in,
                                 const glm::vec3& out);

/// Mirrors `out` in a normal drawn from those that are visible from it (Heitz 2018). Where the
/// result is below the surface, the path ends: the density above integrates to less than 1.
[[nodiscard]] glm::vec3 sample_ggx(float alpha, const glm::vec3& out, glm::vec2 u);
[[nodiscard]] float ggx_density(float alpha, const glm::vec3& in, const glm::vec3& out);

/// Reflected share of light from an angle is f0 * share.normal + (1 - f0) * share.grazing: what the
/// lobe reflects with F = 1, and with F = (1 - cos)^5.
struct GgxShares {
    float normal = 0.0f, grazing = 0.0f;
    [[nodiscard]] Spectrum albedo(const Spectrum& f0) const {
        return normal * f0 + grazing * (Spectrum(1.0f) - f0);
    }
    [[nodiscard]] float albedo(float f0) const { return normal * f0 + grazing * (1.0f - f0); }
};

/// At an angle, and the cosine-weighted mean. From a table: within 1e-3 where cos theta > 0.02, and
/// within 4e-3 nearer to the horizon, but nowhere below the truth by more than ggx_table_error.
[[nodiscard]] GgxShares ggx_shares(float alpha, float cos_theta);
[[nodiscard]] GgxShares ggx_mean_shares(float alpha);
inline constexpr float ggx_table_error = 1.5e-3f;

}  // namespace transillum
