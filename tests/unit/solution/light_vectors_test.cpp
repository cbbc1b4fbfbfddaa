// Bakes that keep direct light as light vectors, beside those that keep every light sample.
#include "solution/incoming_light.h"
#include "solution/memory_estimate.h"
#include "support/scene_builder.h"

#include <transillum/base/error.h>
#include <transillum/solution/bake.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace transillum::test {

namespace {

using namespace testing_support;

Scene glossy_room() {
    SceneBuilder builder;
    Material& m = builder.scene.materials[0];
    m.diffuse = Spectrum(0.3f);
    m.specular = Spectrum(0.4f);
    m.lobe = Lobe::max_phong;
    m.shininess = 10.0f;
    builder.box({-1, -1, 0}, {1, 1, 1.5}, Facing::inwards);
    builder.polygon({{-0.2, -0.2, 1.4}, {-0.2, 0.2, 1.4}, {0.2, 0.2, 1.4}, {0.2, -0.2, 1.4}},
                    builder.material(Spectrum(0.0f), Spectrum(10.0f, 5.0f, 1.0f)));
    return builder.scene;
}

Solution bake_with(FirstShot choice, std::uint64_t memory = 0) {
    BakeOptions options;
    options.subdivision.leaf_target = 600;
    options.light = {.first_shot = choice, .samples = 64};
    options.hemicube_resolution = 64;
    options.iteration.iterations = 64;
    options.memory = memory;
    Monitor silent;
    return bake(glossy_room(), options, Workers(2), silent);
}

const Solution& of_samples() {
    static const Solution solution = bake_with(FirstShot::hemicube);
    return solution;
}
const Solution& of_vectors() {
    static const Solution solution = bake_with(FirstShot::vectors);
    return solution;
}

std::vector<IncomingLight> incoming_at(const Solution& s, std::uint32_t patch) {
    std::vector<IncomingLight> incoming;
    append_incoming_light(s, patch, incoming);
    return incoming;
}

}  // namespace

TEST(LightVectors, BringTheSameIrradiance) {
    const Solution &a = of_samples(), &b = of_vectors();
    ASSERT_EQ(a.direct_irradiance.size(), b.direct_irradiance.size());
    for (std::size_t p = 0; p < a.direct_irradiance.size(); ++p)
        for (int c = 0; c < channel_count; ++c)
            ASSERT_NEAR(b.direct_irradiance[p][c], a.direct_irradiance[p][c],
                        1e-6f * a.direct_irradiance[p][c]);
}

// One direction for a lamp's: off by no more than its BRDF varies over the lamp.
TEST(LightVectors, ReflectWhatTheirLuminaireDoes) {
    const Solution &a = of_samples(), &b = of_vectors();
    int compared = 0;
    for (const GlossySide& side : a.glossy.sides)
        for (std::uint32_t p = side.first_patch; p < side.first_patch + side.leaf_count; ++p) {
            const auto samples = incoming_at(a, p), vectors = incoming_at(b, p);
            if (samples.empty()) {
                EXPECT_TRUE(vectors.empty());
                continue;
            }
            ASSERT_EQ(vectors.size(), 1u);
            const Brdf& brdf = a.glossy.brdfs[side.brdf];
            for (const glm::vec3 out :
                 {glm::vec3(0, 0, 1), glm::vec3(0.6, 0, 0.8), glm::vec3(-0.48, 0.64, 0.6)}) {
                float expected = 0.0f, low = 1e9f, high = 0.0f;
                for (const IncomingLight& light : samples) {
                    const float f = evaluate(brdf, light.direction, out).x;
                    expected += light.irradiance.x * f;
                    low = std::min(low, f);
                    high = std::max(high, f);
                }
                const float found =
                    vectors[0].irradiance.x * evaluate(brdf, vectors[0].direction, out).x;
                // Between the samples the value may pass those at them a little.
                const float variation = 1.1f * (high - low) * vectors[0].irradiance.x;
                ASSERT_NEAR(found, expected, variation + 1e-5f * expected);
                ++compared;
            }
        }
    EXPECT_GT(compared, 300);
}

// What glossy patches reflect in all sees every direction through the albedo alone, which hardly
// varies over a lamp: so does what the iteration starts from.
TEST(LightVectors, HardlyChangeTheIteration) {
    const EnergyBalance &a = of_samples().balance, &b = of_vectors().balance;
    EXPECT_EQ(a.emitted, b.emitted);
    for (int c = 0; c < channel_count; ++c) {
        EXPECT_NEAR(b.absorbed[c], a.absorbed[c], 2e-3 * a.absorbed[c]);
        EXPECT_NEAR(b.escaped[c], a.escaped[c], 2e-3 * a.emitted[c]);
    }
}

TEST(LightVectors, AreADecisionThatSaysWhatTheySave) {
    const auto& decisions = of_vectors().decisions;
    const auto at = std::ranges::find_if(decisions, [](const Decision& d) {
        return d.what.starts_with("1 light vector a patch, ");
    });
    ASSERT_NE(at, decisions.end());
    EXPECT_THAT(at->why, testing::HasSubstr("all samples would take"));
    EXPECT_THAT(of_samples().decisions, testing::Not(testing::Contains(testing::Field(
                                            &Decision::what, testing::HasSubstr("light vector")))));
}

TEST(LightVectors, FitWhereTheTablesDoNot) {
    const Luminaires luminaires =
        sample_luminaires(of_samples().surface, {.first_shot = FirstShot::hemicube, .samples = 64});
    const std::uint64_t needed = estimate_memory(of_samples(), luminaires, 2).total();
    EXPECT_THROW((void)bake_with(FirstShot::hemicube, needed - 1), UsageError);
    EXPECT_NO_THROW((void)bake_with(FirstShot::vectors, needed - 1));
}

}  // namespace transillum::test
