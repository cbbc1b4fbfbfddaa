#include "scene/ggx.h"
#include "scene/max_phong.h"

#include <transillum/base/sampling.h>
#include <transillum/scene/brdf.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

constexpr float inv_pi = std::numbers::inv_pi_v<float>;
/// Directions nearer to the horizon count as below: values would overflow.
constexpr float least_cosine = 1e-6f;
/// Where a lobe leaves less, its tabled albedo is too coarse to share out the rest by.
constexpr float least_coupling = 1e-2f;

bool above(const glm::vec3& direction) {
    return direction.z > least_cosine;
}

/// Share of the samples that go to the lobe.
float lobe_chance(const Brdf& brdf, float cos_theta) {
    if (brdf.lobe == Lobe::none) return 0.0f;
    const float lobe = mean_channel(lobe_albedo(brdf, cos_theta));
    return lobe > 0.0f ? lobe / (lobe + mean_channel(brdf.diffuse)) : 0.0f;
}

float lobe_density(const Brdf& brdf, const glm::vec3& in, const glm::vec3& out) {
    return brdf.lobe == Lobe::max_phong ? max_phong_density(brdf.shininess, in, out)
                                        : ggx_density(brdf.alpha, in, out);
}

}  // namespace

Spectrum Material::albedo() const {
    return lobe == Lobe::ggx ? mean_albedo(brdf_of(*this)) : diffuse + specular;
}

Brdf brdf_of(const Material& material) {
    Brdf brdf;
    brdf.diffuse = material.diffuse;
    if (material.lobe == Lobe::none || !(max_channel(material.specular) > 0.0f)) return brdf;
    brdf.specular = material.specular;
    brdf.lobe = material.lobe;
    brdf.shininess = std::max(least_shininess, material.shininess);
    brdf.alpha = std::clamp(material.roughness * material.roughness, least_alpha, 1.0f);
    return brdf;
}

Spectrum evaluate(const Brdf& brdf, const glm::vec3& in, const glm::vec3& out) {
    return evaluate_diffuse(brdf, in, out) + evaluate_lobe(brdf, in, out);
}

Spectrum evaluate_diffuse(const Brdf& brdf, const glm::vec3& in, const glm::vec3& out) {
    if (!above(in) || !above(out)) return Spectrum(0.0f);
    if (brdf.lobe != Lobe::ggx) return inv_pi * brdf.diffuse;
    const float coupling = diffuse_coupling(brdf, in.z) * diffuse_coupling(brdf, out.z);
    return brdf.diffuse * (inv_pi * coupling / mean_diffuse_coupling(brdf));
}

Brdf widened(const Brdf& brdf, float solid_angle) {
    constexpr float pi = std::numbers::pi_v<float>;
    /// Of the lobe's own solid angle: less does not show.
    constexpr float least = 0.01f;
    Brdf wide = brdf;
    if (brdf.lobe == Lobe::max_phong) {
        const float own = 2.0f * pi / (brdf.shininess + 2.0f);
        if (solid_angle > least * own)
            wide.shininess = std::max(least_shininess, 2.0f * pi / (own + solid_angle) - 2.0f);
    }
    if (brdf.lobe == Lobe::ggx) {
        const float own = 4.0f * pi * brdf.alpha * brdf.alpha;
        if (solid_angle > least * own)
            wide.alpha = std::min(1.0f, std::sqrt((own + solid_angle) / (4.0f * pi)));
    }
    return wide;
}

Spectrum evaluate_lobe(const Brdf& brdf, const glm::vec3& in, const glm::vec3& out) {
    if (!above(in) || !above(out)) return Spectrum(0.0f);
    switch (brdf.lobe) {
        case Lobe::max_phong:
            return brdf.specular * max_phong_value(brdf.shininess, in, out);
        case Lobe::ggx:
            return ggx_value(brdf.specular, brdf.alpha, in, out);
        case Lobe::none:
            break;
    }
    return Spectrum(0.0f);
}

void evaluate(const Brdf& brdf, std::span<const glm::vec3> in, const glm::vec3& out,
              std::span<Spectrum> values) {
    if (brdf.lobe != Lobe::max_phong || !above(out)) {
        for (std::size_t i = 0; i < in.size(); ++i) values[i] = evaluate(brdf, in[i], out);
        return;
    }
    const Spectrum diffuse = inv_pi * brdf.diffuse;
    const MaxPhongTowards lobe(brdf.shininess, out);
    for (std::size_t i = 0; i < in.size(); ++i)
        values[i] = above(in[i]) ? diffuse + brdf.specular * lobe.value(in[i]) : Spectrum(0.0f);
}

Spectrum directional_albedo(const Brdf& brdf, float cos_theta) {
    return brdf.diffuse * diffuse_coupling(brdf, cos_theta) + lobe_albedo(brdf, cos_theta);
}

Spectrum lobe_albedo(const Brdf& brdf, float cos_theta) {
    switch (brdf.lobe) {
        case Lobe::max_phong:
            return brdf.specular * max_phong_albedo(brdf.shininess, cos_theta);
        case Lobe::ggx:
            return ggx_shares(brdf.alpha, cos_theta).albedo(brdf.specular);
        case Lobe::none:
            break;
    }
    return Spectrum(0.0f);
}

float diffuse_coupling(const Brdf& brdf, float cos_theta) {
    if (brdf.lobe != Lobe::ggx) return 1.0f;
    const float lobe = ggx_shares(brdf.alpha, cos_theta).albedo(max_channel(brdf.specular));
    return std::max(0.0f, 1.0f - ggx_table_error - lobe);
}

float mean_diffuse_coupling(const Brdf& brdf) {
    if (brdf.lobe != Lobe::ggx) return 1.0f;
    const float lobe = ggx_mean_shares(brdf.alpha).albedo(max_channel(brdf.specular));
    return std::max(least_coupling, 1.0f - ggx_table_error - lobe);
}

Spectrum mean_albedo(const Brdf& brdf) {
    const Spectrum diffuse = brdf.diffuse * mean_diffuse_coupling(brdf);
    switch (brdf.lobe) {
        case Lobe::max_phong:
            return diffuse + brdf.specular * max_phong_mean_albedo(brdf.shininess);
        case Lobe::ggx:
            return diffuse + ggx_mean_shares(brdf.alpha).albedo(brdf.specular);
        case Lobe::none:
            break;
    }
    return diffuse;
}

glm::vec3 sample_direction(const Brdf& brdf, const glm::vec3& out, float choice, glm::vec2 u) {
    if (!above(out)) return {0.0f, 0.0f, -1.0f};
    if (choice >= lobe_chance(brdf, out.z)) return cosine_direction(u.x, u.y);
    return brdf.lobe == Lobe::max_phong ? sample_max_phong(brdf.shininess, out, u)
                                        : sample_ggx(brdf.alpha, out, u);
}

float direction_density(const Brdf& brdf, const glm::vec3& in, const glm::vec3& out) {
    if (!above(in) || !above(out)) return 0.0f;
    const float diffuse = inv_pi * in.z;
    const float chance = lobe_chance(brdf, out.z);
    if (!(chance > 0.0f)) return diffuse;
    return (1.0f - chance) * diffuse + chance * lobe_density(brdf, in, out);
}

}  // namespace transillum
