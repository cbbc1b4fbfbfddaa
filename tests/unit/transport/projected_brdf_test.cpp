#include "transport/projected_brdf.h"

#include <transillum/base/sampling.h>

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace transillum;

Brdf max_phong(float specular, float shininess) {
    return {Spectrum(0.2f), Spectrum(specular), Lobe::max_phong, shininess};
}

Brdf ggx(float reflectance, float alpha) {
    return {Spectrum(0.3f), Spectrum(reflectance), Lobe::ggx, 0.0f, alpha};
}

const std::vector<Brdf>& lobes() {
    static const std::vector<Brdf> all{max_phong(0.5f, 3.0f),   max_phong(0.7f, 10.0f),
                                       max_phong(0.7f, 200.0f), ggx(0.04f, 0.25f),
                                       ggx(0.9f, 0.1f),         ggx(0.9f, 1.0f)};
    return all;
}

// All bins together reflect what the lobe does: between table entries only interpolation differs.
TEST(ProjectedBrdf, KeepsTheLobesAlbedo) {
    for (const Brdf& brdf : lobes())
        for (int level = 0; level <= max_bin_level; ++level) {
            const ProjectedBrdf projected(brdf, level);
            std::vector<float> bins(bin_count(level));
            for (int i = 0; i < 200; ++i) {
                const glm::vec3 in(cosine_direction(sobol_owen(i, 0, 1), sobol_owen(i, 1, 1)));
                if (in.z < 0.2f) continue;
                projected.lobe_into_bins(in, bins);
                float sum = 0.0f;
                for (const float f : bins)
                    sum += f * std::numbers::pi_v<float> / static_cast<float>(bin_count(level));
                EXPECT_NEAR(sum, mean_channel(lobe_albedo(brdf, in.z)), 0.01f);
            }
        }
}

// By reciprocity: uniform light, met bin by bin, comes out with the lobe's albedo.
TEST(ProjectedBrdf, AgreesWithTheBinsAlbedo) {
    for (const Brdf& brdf : {max_phong(0.5f, 3.0f), max_phong(0.7f, 10.0f), ggx(0.9f, 0.3f)}) {
        const ProjectedBrdf projected(brdf, 2);
        std::vector<float> bins(bin_count(2)), sum(bin_count(2));
        const int n = 4096;
        for (int i = 0; i < n; ++i) {
            const glm::vec3 in(cosine_direction(sobol_owen(i, 0, 1), sobol_owen(i, 1, 1)));
            projected.lobe_into_bins(in, bins);
            for (std::size_t j = 0; j < bins.size(); ++j)
                sum[j] += bins[j] * std::numbers::pi_v<float> / n;
        }
        for (std::size_t j = 0; j < bins.size(); ++j)
            EXPECT_NEAR(sum[j], mean_channel(projected.lobe_albedo(static_cast<int>(j))), 0.01f)
                << j;
    }
}

TEST(ProjectedBrdf, SendsTheLobeWhereAMirrorWould) {
    const ProjectedBrdf projected(max_phong(0.7f, 200.0f), max_bin_level);
    std::vector<float> bins(bin_count(max_bin_level));
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 in(cosine_direction(sobol_owen(i, 0, 2), sobol_owen(i, 1, 2)));
        projected.lobe_into_bins(in, bins);
        const glm::vec2 mirror = square_of_direction({-in.x, -in.y, in.z});
        const auto brightest = std::max_element(bins.begin(), bins.end()) - bins.begin();
        const int side = 1 << max_bin_level;
        const glm::vec2 centre =
            (glm::vec2(brightest % side, brightest / side) + 0.5f) / static_cast<float>(side);
        EXPECT_LT(std::max(std::abs(centre.x - mirror.x), std::abs(centre.y - mirror.y)),
                  1.0f / static_cast<float>(side));
    }
}

}  // namespace
