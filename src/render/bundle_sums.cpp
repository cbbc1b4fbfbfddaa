#include "render/bundle_sums.h"

#include <transillum/solution/patch_sources.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

BundleSums::BundleSums(const Solution& solution, const SolutionShader& shader,
                       MonteCarlo representation, std::uint64_t seed, const Workers& workers)
    : solution_(solution),
      shader_(shader),
      workers_(workers),
      sources_(make_sources(solution)),
      light_(solution.surface, solution.patches, sources_, solution.indirect_irradiance,
             solution.glossy_elements,
             {representation, automatic_pixel_size(solution.surface, solution.patches), seed},
             workers),
      shines_(shines(sources_)),
      gains_(2 * solution.surface.triangles.size()) {
    std::uint64_t bins = 0;
    for (const GlossySide& side : solution.glossy.sides) {
        first_weight_.push_back(bins);
        bins += static_cast<std::uint64_t>(side.bins());
    }
    weights_.resize(bins);
}

void BundleSums::forget() {
    light_.forget_projected();
    std::ranges::fill(weights_, 0.0f);
    count_ = 0;
}

void BundleSums::next() {
    light_.next();
    ++count_;
    workers_.for_ranges(gains_.size() / 2, 1024, [&](std::size_t begin, std::size_t end, int) {
        for (auto root = static_cast<std::uint32_t>(begin); root < end; ++root)
            for (const bool back : {false, true}) prepare_side(root, back);
    });
}

void BundleSums::prepare_side(std::uint32_t root, bool back) {
    const glm::dvec3 normal = shader_.facets()[root].side_normal(back);
    const double cosine = glm::dot(normal, light_.direction());
    const auto twice_cosine = static_cast<float>(2.0 * std::abs(cosine));
    LambertGain& g = gains_[2 * std::size_t{root} + (back ? 1 : 0)];
    g = {twice_cosine, 0.0f, nullptr};
    const GlossySide* const side = has_glossy() ? solution_.glossy.find(root, back) : nullptr;
    if (!side) return;
    const glm::vec3 in = glm::vec3(light_.direction() * (cosine < 0.0 ? -1.0 : 1.0)) *
                         shader_.glossy().world_from_local(*side);
    const int bin = bin_at(square_of_direction(in), side->bin_level);
    const auto s = static_cast<std::size_t>(side - solution_.glossy.sides.data());
    weights_[first_weight_[s] + bin] += twice_cosine * static_cast<float>(side->bins());
    const Brdf& brdf = solution_.glossy.brdfs[side->brdf];
    if (brdf.lobe != Lobe::ggx) return;
    const ProjectedBrdf& projection = solution_.glossy.projections[side->projection];
    float whole = 0.0f;
    for (int k = 0; k < side->bins(); ++k) whole += projection.coupling(k);
    if (!(whole > 0.0f)) return;
    const float to_mean = static_cast<float>(side->bins()) / whole;
    const float coupling = to_mean * diffuse_coupling(brdf, std::max(0.0f, in.z));
    g.gain = twice_cosine * coupling;
    g.control = twice_cosine * (coupling - to_mean * projection.coupling(bin));
    g.elements = &solution_.glossy_elements[side->element(bin, side->first_patch)];
}

Spectrum BundleSums::lobe_term(const SurfacePoint& p, const Spectrum& incoming) const {
    const glm::dvec3 from =
        light_.direction() * (glm::dot(p.normal, light_.direction()) < 0.0 ? -1.0 : 1.0);
    const glm::vec3 in = p.local(from);
    const Spectrum reflected = evaluate_lobe(p.brdf, in, p.out);
    if (!(max_channel(reflected) > 0.0f)) return Spectrum(0.0f);
    return 2.0f * std::numbers::pi_v<float> * in.z * reflected *
           (incoming - shader_.glossy().incoming(p, from));
}

GlossyField BundleSums::excess(const BundleLight::Projected& projected) const {
    std::vector<Spectrum> elements = projected.glossy_elements;
    const float share = 1.0f / static_cast<float>(std::max(1, count_));
    for (std::size_t s = 0; s < solution_.glossy.sides.size(); ++s) {
        const GlossySide& side = solution_.glossy.sides[s];
        for (int k = 0; k < side.bins(); ++k) {
            const float n = share * weights_[first_weight_[s] + k];
            const std::uint64_t first = side.element(k, side.first_patch);
            for (std::uint64_t e = first; e < first + side.leaf_count; ++e)
                elements[e] -= n * solution_.glossy_elements[e];
        }
    }
    return shader_.glossy().with_elements(elements);
}

}  // namespace transillum
