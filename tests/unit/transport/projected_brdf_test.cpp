#include <transillum/base/sampling.h>
#include <transillum/transport/projected_brdf.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <vector>

namespace {

using namespace transillum;

Brdf max_phong(float specular, float shininess) {
    return {Spectrum(0.2f), Spectrum(specular), Lobe::max_phong, shininess};
}

Brdf ggx(float reflectance, float alpha) {
    return {Spectrum(0.3f), Spectrum(reflectance), Lobe::ggx, 0.0f, alpha};
}

glm::vec3 direction(int i) {
    const auto index = static_cast<std::uint32_t>(i);
    return glm::vec3(cosine_direction(sobol_owen(index, 0, 1), sobol_owen(index, 1, 1)));
}

const std::vector<Brdf>& lobes() {
    static const std::vector<Brdf> all{max_phong(0.5f, 3.0f),   max_phong(0.7f, 10.0f),
                                       max_phong(0.7f, 200.0f), ggx(0.04f, 0.25f),
                                       ggx(0.9f, 0.1f),         ggx(0.9f, 1.0f)};
    return all;
}

TEST(ProjectedBrdf, SharesSumToOne) {
    for (const Brdf& brdf : lobes())
        for (int level = 0; level <= max_bin_level; ++level) {
            const ProjectedBrdf projected(brdf, level);
            std::vector<float> shares(bin_count(level));
            for (int i = 0; i < 200; ++i) {
                projected.shares(direction(i), shares);
                EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0f), 1.0f, 1e-5f);
            }
        }
}

// By definition: the integral of f cos over the bin, here by sampling the bins.
TEST(ProjectedBrdf, SharesAreIntegralsOverTheBins) {
    for (const Brdf& brdf : {max_phong(0.5f, 3.0f), max_phong(0.7f, 10.0f), ggx(0.9f, 0.3f)}) {
        const ProjectedBrdf projected(brdf, 2);
        std::vector<float> shares(bin_count(2));
        for (int i = 0; i < 20; ++i) {
            const glm::vec3 out = direction(i);
            if (out.z < 0.2f) continue;
            projected.shares(out, shares);
            std::vector<double> sum(shares.size());
            const int n = 1 << 14;
            for (int k = 0; k < n; ++k) {
                const glm::vec3 in = direction(k);
                sum[static_cast<std::size_t>(bin_at(square_of_direction(in), 2))] +=
                    std::numbers::pi / n * mean_channel(evaluate_lobe(brdf, in, out));
            }
            const double albedo = mean_channel(lobe_albedo(brdf, out.z));
            for (std::size_t k = 0; k < shares.size(); ++k)
                EXPECT_NEAR(shares[k], sum[k] / albedo, 0.02) << k;
        }
    }
}

TEST(ProjectedBrdf, LieWhereAMirrorWouldSendTheLobe) {
    const ProjectedBrdf projected(max_phong(0.7f, 200.0f), max_bin_level);
    std::vector<float> shares(bin_count(max_bin_level));
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 out = direction(i);
        projected.shares(out, shares);
        const glm::vec2 mirror = square_of_direction({-out.x, -out.y, out.z});
        const auto brightest = std::max_element(shares.begin(), shares.end()) - shares.begin();
        const int side = 1 << max_bin_level;
        const glm::vec2 centre =
            (glm::vec2(brightest % side, brightest / side) + 0.5f) / static_cast<float>(side);
        EXPECT_LT(std::max(std::abs(centre.x - mirror.x), std::abs(centre.y - mirror.y)),
                  1.0f / static_cast<float>(side));
    }
}

}  // namespace
