/// The max-Phong lobe: f = ks cos^n(alpha) / max(cos theta, cos theta'), ks = (n + 2) / (2 pi) for
/// an albedo of 1 at normal incidence (Neumann, Neumann and Szirmay-Kalos 1999, "Compact metallic
/// reflectance models"). Directions are above the surface.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace transillum {

[[nodiscard]] float max_phong_value(float shininess, const glm::vec3& in, const glm::vec3& out);

/// Directions with density (n + 1) / (2 pi) cos^n(alpha); those that would end below the surface
/// are mirrored back above it, so that none is lost and the density is the sum of both.
[[nodiscard]] glm::vec3 sample_max_phong(float shininess, const glm::vec3& out, glm::vec2 u);
[[nodiscard]] float max_phong_density(float shininess, const glm::vec3& in, const glm::vec3& out);

/// Reflected share of light from an angle, and its cosine-weighted mean, from a table: within
/// 1e-3.
[[nodiscard]] float max_phong_albedo(float shininess, float cos_theta);
[[nodiscard]] float max_phong_mean_albedo(float shininess);

}  // namespace transillum
