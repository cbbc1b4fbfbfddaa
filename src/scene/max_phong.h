/// The max-Phong lobe: f = ks cos^n(alpha) / max(cos theta, cos theta'), ks = (n + 2) / (2 pi) for
/// an albedo of 1 at normal incidence (Neumann, Neumann and Szirmay-Kalos 1999, "Compact metallic
/// reflectance models"). Directions are above the surface.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

/// cos^n between unit vectors, 0 beyond a right angle. The cosine's distance from 1 is taken from
/// the vectors' difference: n times the rounding of a dot product would show in sharp lobes.
class CosinePower {
public:
    explicit CosinePower(float n)
        : n_(n), whole_(n <= largest_whole && n == std::floor(n) ? static_cast<int>(n) : 0) {}

    [[nodiscard]] float of_cosine(const glm::vec3& a, const glm::vec3& b) const {
        const glm::vec3 difference = a - b;
        const float below_one = 0.5f * glm::dot(difference, difference);
        if (!(below_one < 1.0f)) return 0.0f;
        // log(1 - x) <= -x: less than floats hold. Most of a hemisphere is that far from a sharp
        // lobe, and what underflows takes long.
        if (n_ * below_one > underflow) return 0.0f;
        return whole_ > 0 ? whole_power(1.0f - below_one) : std::exp(n_ * std::log1p(-below_one));
    }

private:
    /// Rounding grows with n, so larger exponents are better taken by logarithms.
    static constexpr float largest_whole = 64.0f;
    /// exp of less than minus that is 0.
    static constexpr float underflow = 104.0f;

    [[nodiscard]] float whole_power(float x) const {
        float power = 1.0f;
        for (int n = whole_; n > 0; n >>= 1, x *= x)
            if (n & 1) power *= x;
        return power;
    }

    float n_;
    int whole_;  ///< n where it is whole and not large, else 0
};

[[nodiscard]] float max_phong_value(float shininess, const glm::vec3& in, const glm::vec3& out);

/// Its values for light from many directions: what they share is worked out once.
class MaxPhongTowards {
public:
    MaxPhongTowards(float shininess, const glm::vec3& out)
        : centre_(-out.x, -out.y, out.z),
          scale_((shininess + 2.0f) / (2.0f * std::numbers::pi_v<float>)),
          power_(shininess) {}
    [[nodiscard]] float value(const glm::vec3& in) const {
        return scale_ * power_.of_cosine(in, centre_) / std::max(in.z, centre_.z);
    }

private:
    glm::vec3 centre_;  ///< of the lobe
    float scale_;
    CosinePower power_;
};

/// Directions with density (n + 1) / (2 pi) cos^n(alpha); those that would end below the surface
/// are mirrored back above it, so that none is lost and the density is the sum of both.
[[nodiscard]] glm::vec3 sample_max_phong(float shininess, const glm::vec3& out, glm::vec2 u);
[[nodiscard]] float max_phong_density(float shininess, const glm::vec3& in, const glm::vec3& out);

/// Reflected share of light from an angle, and its cosine-weighted mean, from a table: within
/// 1e-3.
[[nodiscard]] float max_phong_albedo(float shininess, float cos_theta);
[[nodiscard]] float max_phong_mean_albedo(float shininess);

}  // namespace transillum
