/// Reflection at a point of a surface: Lambert, and at most one glossy lobe beside it.
///
///   max-Phong  f = ks cos^n(alpha) / max(cos theta, cos theta'), alpha from the mirror direction,
///              ks = specular (n + 2) / (2 pi); Lambert as it is (paper §6; validation E)
///   GGX        Trowbridge-Reitz with height-correlated Smith shadowing and Schlick's Fresnel term
///              (glTF 2.0, appendix B); Lambert coupled by (1 - E(theta)) (1 - E(theta')) / mean,
///              E the lobe's directional albedo in its strongest channel (Kelemen and Szirmay-Kalos
///              2001), so that the sum is reciprocal and never reflects more than comes in
///
/// Directions are unit and point away from the surface, in a local frame whose z is the normal.
/// Both must be above the surface; otherwise values and densities are 0.
#pragma once

#include <transillum/scene/scene.h>

#include <glm/vec2.hpp>

#include <span>

namespace transillum {

/// Sharper GGX lobes are taken for this one.
inline constexpr float least_alpha = 1e-3f;
/// Blunter max-Phong lobes are taken for this one: they would reflect more of oblique light than of
/// what comes along the normal, 1.086 times as much at an exponent of 0, 1.0003 times at 1.
inline constexpr float least_shininess = 1.0f;

struct Brdf {
    Spectrum diffuse{0.0f}, specular{0.0f};  ///< as in Material
    Lobe lobe = Lobe::none;
    float shininess = least_shininess;  ///< max-Phong, at least that
    float alpha = 1.0f;                 ///< GGX: roughness squared, at least least_alpha
};

/// With its lobe as wide as it becomes by light from a small solid angle [sr] about a direction,
/// taken for that direction: what is reflected of it then never exceeds what it shines with.
[[nodiscard]] Brdf widened(const Brdf& brdf, float solid_angle);

/// Of the material's uniform values. A lobe that reflects nothing is left out.
[[nodiscard]] Brdf brdf_of(const Material& material);

/// Values [1 / sr]: the whole, and its two parts.
[[nodiscard]] Spectrum evaluate(const Brdf& brdf, const glm::vec3& in, const glm::vec3& out);
[[nodiscard]] Spectrum evaluate_diffuse(const Brdf& brdf, const glm::vec3& in,
                                        const glm::vec3& out);
[[nodiscard]] Spectrum evaluate_lobe(const Brdf& brdf, const glm::vec3& in, const glm::vec3& out);

/// The whole for many directions of light and one of the eye: what they share is worked out once.
/// \pre values.size() == in.size()
void evaluate(const Brdf& brdf, std::span<const glm::vec3> in, const glm::vec3& out,
              std::span<Spectrum> values);

/// Share [1] of light from an angle that is reflected: the whole, and by the lobe alone. From
/// tables: within 1e-3, and for GGX within 4e-3 where cos theta < 0.02.
[[nodiscard]] Spectrum directional_albedo(const Brdf& brdf, float cos_theta);
[[nodiscard]] Spectrum lobe_albedo(const Brdf& brdf, float cos_theta);
/// Diffuse value = diffuse / pi * diffuse_coupling(in) * diffuse_coupling(out) / mean, the mean of
/// the coupling over the cosine-weighted hemisphere. 1 unless the lobe is GGX. It is kept below
/// what the lobe truly leaves by the table's error, so that the sum stays below 1.
[[nodiscard]] float diffuse_coupling(const Brdf& brdf, float cos_theta);
[[nodiscard]] float mean_diffuse_coupling(const Brdf& brdf);
/// Reflected share of uniform light, both lobes [1].
[[nodiscard]] Spectrum mean_albedo(const Brdf& brdf);

/// A direction for light to come from, given where it goes: from the diffuse part or the lobe, by
/// their albedos (the diffuse one uncoupled, so that at grazing angles, too, it keeps a share that
/// bounds evaluate_diffuse / density). GGX may send it below the surface, where the path ends: the
/// density above integrates to what is left. \param choice picks the lobe, in [0, 1)
[[nodiscard]] glm::vec3 sample_direction(const Brdf& brdf, const glm::vec3& out, float choice,
                                         glm::vec2 u);
/// Density [1 / sr] with which it is sampled.
[[nodiscard]] float direction_density(const Brdf& brdf, const glm::vec3& in, const glm::vec3& out);

}  // namespace transillum
