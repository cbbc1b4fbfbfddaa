// The white furnace of glossy surfaces: emit Le = 1 - a, and L = 1 everywhere and in every
// direction (validation A1).
#include "physics/transport_runs.h"

#include <transillum/base/sampling.h>
#include <transillum/scene/brdf.h>

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

Material glossy(Lobe lobe, float diffuse, float specular, float shininess, float roughness) {
    Material m;
    m.diffuse = Spectrum(diffuse);
    m.specular = Spectrum(specular);
    m.lobe = lobe;
    m.shininess = shininess;
    m.roughness = roughness;
    return m;
}

/// Mean over a bin of a function of the angle's cosine.
template <class Function>
float mean_in_bin(int level, int bin, Function f) {
    const int n = 4096, side = 1 << level;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const glm::vec2 u(static_cast<float>(sobol_owen(i, 0, 1)),
                          static_cast<float>(sobol_owen(i, 1, 1)));
        const glm::vec2 square = (glm::vec2(bin % side, bin / side) + u) / static_cast<float>(side);
        sum += double{f(direction_of_square(square).z)};
    }
    return static_cast<float>(sum / n);
}

class GlossyFurnace : public testing::TestWithParam<Material> {};

TEST_P(GlossyFurnace, IsOneInEveryBin) {
    SceneBuilder b;
    b.scene.materials[0] = GetParam();
    b.box({0, 0, 0}, {1, 1.5, 0.7}, Facing::inwards);
    TransportRun run = prepare_transport(b.scene, {.leaves = 1500});
    GlossySides& glossy = run.sources.glossy;
    const Brdf& brdf = glossy.brdfs[0];
    const int level = bin_level_for(brdf);
    std::vector<float> coupling, emission;
    for (int j = 0; j < bin_count(level); ++j) {
        coupling.push_back(
            mean_in_bin(level, j, [&](float z) { return diffuse_coupling(brdf, z); }));
        emission.push_back(
            mean_in_bin(level, j, [&](float z) { return 1.0f - directional_albedo(brdf, z).x; }));
    }
    run.sources.element_emission.resize(glossy.element_count);
    for (const GlossySide& s : glossy.sides)
        for (int row = 1; row < s.row_count(); ++row)
            for (std::uint32_t p = s.first_patch; p < s.first_patch + s.leaf_count; ++p)
                run.sources.element_emission[s.element(row, p)] = Spectrum(emission[row - 1]);
    iterate_in(run, {.directions = 1024});

    for (const GlossySide& s : glossy.sides) {
        if (s.back) continue;
        for (std::uint32_t p = s.first_patch; p < s.first_patch + s.leaf_count; ++p) {
            const auto value = [&](int row) {
                return run.result.glossy_elements[s.element(row, p)].x;
            };
            EXPECT_NEAR(value(0), 1.0f, 5e-3f);
            for (int row = 1; row < s.row_count(); ++row)
                EXPECT_NEAR(
                    emission[row - 1] + brdf.diffuse.x * coupling[row - 1] * value(0) + value(row),
                    1.0f, 5e-3f)
                    << "bin " << row - 1;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Lobes, GlossyFurnace,
                         testing::Values(glossy(Lobe::max_phong, 0.3f, 0.4f, 10.0f, 1.0f),
                                         glossy(Lobe::max_phong, 0.0f, 0.9f, 3.0f, 1.0f),
                                         glossy(Lobe::max_phong, 0.1f, 0.8f, 60.0f, 1.0f),
                                         glossy(Lobe::ggx, 0.6f, 0.04f, 0.0f, 0.4f),
                                         glossy(Lobe::ggx, 0.0f, 0.9f, 0.0f, 0.5f)));

// What glossy walls reflect, absorb and let out adds up to what is emitted.
TEST(GlossyBox, KeepsEnergy) {
    for (const float shininess : {3.0f, 10.0f, 30.0f}) {
        SceneBuilder b;
        b.scene.materials[0] = glossy(Lobe::max_phong, 0.3f, 0.5f, shininess, 1.0f);
        b.scene.materials.push_back(b.scene.materials[0]);
        b.scene.materials[1].emission = Spectrum(1.0f);
        b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
        b.scene.polygons[0].material = 1;
        TransportRun run = prepare_transport(b.scene, {.leaves = 1500});
        iterate_in(run, {.directions = 1024});
        double emitted = 0.0, absorbed = 0.0;
        for (const GlossySide& s : run.sources.glossy.sides) {
            if (s.back) continue;
            for (std::uint32_t p = s.first_patch; p < s.first_patch + s.leaf_count; ++p) {
                const double area = leaf_area(run.surface, run.patches, s.root);
                double lobe = 0.0;
                for (int row = 1; row < s.row_count(); ++row)
                    lobe += run.result.glossy_elements[s.element(row, p)].x /
                            double(bin_count(s.bin_level));
                emitted += area * run.sources.emission[p].x;
                absorbed += area * (run.result.irradiance[p].x / std::numbers::pi -
                                    0.3 * run.result.glossy_elements[s.element(0, p)].x - lobe);
            }
        }
        EXPECT_NEAR(absorbed, emitted, 5e-3 * emitted) << "shininess " << shininess;
    }
}

}  // namespace
