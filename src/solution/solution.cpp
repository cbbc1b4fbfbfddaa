#include <transillum/solution/solution.h>

#include "solution/incoming_light.h"

#include <numbers>

namespace transillum {

namespace {

constexpr float inv_pi = std::numbers::inv_pi_v<float>;

Brdf brdf_of_patch(const Solution& solution, const GlossySide& side, std::uint32_t patch) {
    Brdf brdf = solution.glossy.brdfs[side.brdf];
    brdf.diffuse = solution.diffuse(patch);
    return brdf;
}

}  // namespace

const GlossySide* Solution::glossy_side(std::uint32_t patch) const {
    if (glossy.empty()) return nullptr;
    return glossy.find(patches.root_of_leaf[patches.leaf_of_patch(patch)], patches.is_back(patch));
}

Spectrum Solution::direct_radiance(std::uint32_t patch) const {
    const GlossySide* const side = glossy_side(patch);
    if (!side) return diffuse(patch) * direct_irradiance[patch] * inv_pi;
    const Brdf brdf = brdf_of_patch(*this, *side, patch);
    std::vector<IncomingLight> incoming;
    append_incoming_light(*this, patch, incoming);
    Spectrum sum(0.0f);
    for (const IncomingLight& light : incoming)
        sum += light.irradiance * directional_albedo(brdf, light.direction.z);
    return sum * inv_pi;
}

Spectrum Solution::finite_element_radiance(std::uint32_t patch) const {
    const GlossySide* const side = glossy_side(patch);
    if (!side) return diffuse(patch) * indirect_irradiance[patch] * inv_pi;
    const Brdf brdf = brdf_of_patch(*this, *side, patch);
    const ProjectedBrdf& projected = glossy.projections[side->projection];
    Spectrum by_lobe(0.0f), by_lambert(0.0f);
    float coupling = 0.0f;
    for (int k = 0; k < side->bins(); ++k) {
        const Spectrum& incoming = glossy_elements[side->element(k, patch)];
        by_lobe += projected.lobe_albedo(k) * incoming;
        by_lambert += projected.coupling(k) * incoming;
        coupling += projected.coupling(k);
    }
    return by_lobe / static_cast<float>(side->bins()) +
           brdf.diffuse * by_lambert * (mean_diffuse_coupling(brdf) / coupling);
}

}  // namespace transillum
