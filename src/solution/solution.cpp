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
    Spectrum lobe(0.0f);
    for (int row = 1; row < side->row_count(); ++row)
        lobe += glossy_elements[side->element(row, patch)];
    return brdf.diffuse * mean_diffuse_coupling(brdf) * glossy_elements[side->element(0, patch)] +
           lobe / static_cast<float>(bin_count(side->bin_level));
}

}  // namespace transillum
