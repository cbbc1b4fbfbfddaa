// CIE 171:2006 case 5.8: a 4 m cube, 10 000 lm from its centre, all surfaces of one albedo. The
// source is a black cube of 2 cm here, sent by first shot.
#include "support/scene_builder.h"

#include <transillum/solution/bake.h>

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

constexpr double flux = 10000.0;

Solution bake_cube(float albedo) {
    SceneBuilder b;
    b.box({-2, -2, -2}, {2, 2, 2}, Facing::inwards, b.material(Spectrum(albedo)));
    const double half = 0.01, area = 24.0 * half * half;
    b.box(
        glm::dvec3(-half), glm::dvec3(half), Facing::outwards,
        b.material(Spectrum(0.0f), Spectrum(static_cast<float>(flux / (std::numbers::pi * area)))));
    BakeOptions options;
    options.subdivision.leaf_target = 3000;
    options.iteration.iterations = 256;
    Monitor silent;
    return bake(b.scene, options, Workers(2), silent);
}

/// Over the walls: the first twelve roots.
double wall_mean(const Solution& s, const std::vector<Spectrum>& irradiance) {
    double sum = 0.0, area = 0.0;
    for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf) {
        const std::uint32_t root = s.patches.root_of_leaf[leaf];
        if (root >= 12) continue;
        const double a = area_of_leaf(s.surface, s.patches, leaf);
        sum += a * irradiance[leaf].x;
        area += a;
    }
    return sum / area;
}

class PointSource : public testing::TestWithParam<float> {};

TEST_P(PointSource, IndirectIlluminanceFollowsFromTheFlux) {
    const double rho = GetParam();
    const Solution s = bake_cube(GetParam());
    EXPECT_NEAR(wall_mean(s, s.direct_irradiance), flux / 96.0, 0.005 * flux / 96.0);
    const double expected = flux * rho / (96.0 * (1.0 - rho));
    EXPECT_NEAR(wall_mean(s, s.indirect_irradiance) / expected, 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Albedos, PointSource, testing::Values(0.05f, 0.3f, 0.6f, 0.8f, 0.95f));

TEST(BlackScene, HasNoIndirectLight) {
    const Solution s = bake_cube(0.0f);
    for (const Spectrum& e : s.indirect_irradiance) EXPECT_EQ(e, Spectrum(0.0f));
    EXPECT_EQ(s.iterations, 0u) << "work was done that the scene does not need";
}

}  // namespace
