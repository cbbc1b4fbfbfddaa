#include "random_solution.h"

#include <gtest/gtest.h>

#include <numbers>

namespace transillum::test {

namespace {

/// One triangle, front and back patch.
Solution one_triangle() {
    Solution solution = random_solution({.levels = {0}}, 1);
    Material& material = solution.surface.materials[0];
    material.diffuse = Spectrum(0.5f, 0.25f, 0.0f);
    material.specular = Spectrum(0.25f, 0.0f, 0.0f);
    solution.direct_irradiance.assign(2, Spectrum(2.0f));
    solution.indirect_irradiance.assign(2, Spectrum(4.0f));
    return solution;
}

void expect_near(const Spectrum& a, const Spectrum& b) {
    // Two roundings in float.
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 2 * 0x1p-23f * b[i]);
}

}  // namespace

TEST(Radiance, IsAlbedoTimesIrradianceOverPi) {
    const Solution solution = one_triangle();
    const float pi = std::numbers::pi_v<float>;
    for (const std::uint32_t patch : {0u, 1u}) {
        expect_near(solution.direct_radiance(patch), Spectrum(1.5f, 0.5f, 0.0f) / pi);
        expect_near(solution.finite_element_radiance(patch), Spectrum(3.0f, 1.0f, 0.0f) / pi);
    }
}

TEST(Radiance, BlackBackReflectsNothing) {
    Solution solution = one_triangle();
    solution.surface.materials[0].back_reflects = false;
    EXPECT_GT(solution.direct_radiance(0).x, 0.0f);
    EXPECT_EQ(solution.direct_radiance(1), Spectrum(0.0f));
    EXPECT_EQ(solution.finite_element_radiance(1), Spectrum(0.0f));
}

}  // namespace transillum::test
