// What glossy sides reflect of one bundle towards the next, beside their elements.
#include "transport/glossy_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace transillum {

void GlossyElements::reflect_residual(const Bundle& last, const Bundle& next,
                                      const MonteCarloComponent& residual,
                                      std::span<BundleReflection> reflections) const {
    for_chunks([&](const Chunk& c) {
        const GlossySide& s = sides_[c.side];
        const Brdf& f = brdf(s);
        const glm::vec3 in = direction_above(c.side, last), out = direction_above(c.side, next);
        const float twice_cosine = 2.0f * in.z;
        const float diffuse = twice_cosine * diffuse_coupling(f, in.z) *
                              diffuse_coupling(f, out.z) / mean_diffuse_coupling(f);
        Spectrum lobe(0.0f), projected_lobe(0.0f);
        float projected_diffuse = diffuse;
        if (!feeds_back_) {
            lobe = twice_cosine * std::numbers::pi_v<float> * evaluate_lobe(f, in, out);
            projected_diffuse = 0.0f;
        } else if (!is_sharper_than_bins(f)) {
            // Lobes that bins can't hold would carry little but noise.
            const ProjectedBrdf& projection = projected(s);
            const auto bins = static_cast<std::size_t>(s.bins());
            const auto bin = static_cast<std::size_t>(bin_at(square_of_direction(in), s.bin_level));
            std::array<float, bin_count(max_bin_level)> shares;
            projection.shares(out, std::span(shares).first(bins));
            float all = 0.0f;
            for (std::size_t k = 0; k < bins; ++k) all += projection.coupling(static_cast<int>(k));
            const float weight = twice_cosine * static_cast<float>(bins);
            lobe = twice_cosine * std::numbers::pi_v<float> * evaluate_lobe(f, in, out);
            projected_lobe = weight * shares[bin] * lobe_albedo(f, out.z);
            projected_diffuse = weight * projection.coupling(static_cast<int>(bin)) / all *
                                diffuse_coupling(f, out.z);
        }
        for (std::uint32_t p = s.first_patch + c.begin; p < s.first_patch + c.end; ++p) {
            const std::uint32_t slot = slot_of_patch(p, patches_.leaf_count);
            if (feeds_back_ && !(residual.arrived(slot).coverage > 0.0f)) {
                reflections[slot] = {};
                continue;
            }
            const Spectrum& albedo = sources_.albedo[p];
            reflections[slot] = {lanes_of(diffuse * albedo + lobe),
                                 lanes_of((projected_diffuse * albedo + projected_lobe) *
                                          residual.arrived(slot).radiance)};
        }
    });
}

float GlossyElements::largest_gain() const {
    constexpr int tried = 64;
    float most = 0.0f;
    for (const Brdf& f : sources_.glossy.brdfs) {
        if (is_sharper_than_bins(f)) continue;
        for (int i = 1; i <= tried; ++i) {
            const float z = static_cast<float>(i) / tried;
            const glm::vec3 in(std::sqrt(1.0f - z * z), 0.0f, z);
            most = std::max(most, 2.0f * std::numbers::pi_v<float> * z *
                                      max_channel(evaluate_lobe(f, in, mirrored(in))));
        }
    }
    return most;
}

}  // namespace transillum
