#include "random_solution.h"

#include "solution/incoming_light.h"

#include <gtest/gtest.h>

#include <numbers>

namespace transillum::test {

namespace {

/// One triangle, front and back patch.
Solution one_triangle() {
    Solution solution = random_solution({.levels = {0}}, 1);
    Material& material = solution.surface.materials[0];
    material.lobe = Lobe::none;
    material.diffuse = Spectrum(0.75f, 0.25f, 0.0f);
    solution.glossy = lay_out_glossy_sides(solution.surface, solution.patches,
                                           choose_bin_levels(solution.surface, {}));
    solution.glossy_elements.resize(solution.glossy.element_count);
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

// Uniform light comes back by the directional albedo from each light, and by the mean one from all
// around.
TEST(Radiance, OfAGlossyPatchIsWhatItsAlbedosReflect) {
    Solution solution = one_triangle();
    Material& material = solution.surface.materials[0];
    for (const Lobe lobe : {Lobe::max_phong, Lobe::ggx}) {
        material.lobe = lobe;
        material.specular = Spectrum(0.2f);
        material.shininess = 10.0f;
        material.roughness = 0.6f;
        const Brdf brdf = brdf_of(material);
        solution.glossy = lay_out_glossy_sides(solution.surface, solution.patches,
                                               choose_bin_levels(solution.surface, {}));
        solution.glossy_elements.assign(solution.glossy.element_count, Spectrum(3.0f));
        const Spectrum fe = solution.finite_element_radiance(0);
        for (int c = 0; c < channel_count; ++c)
            EXPECT_NEAR(fe[c], 3.0f * mean_albedo(brdf)[c], 5e-3f);
        std::vector<IncomingLight> incoming;
        append_incoming_light(solution, 0, incoming);
        ASSERT_FALSE(incoming.empty());
        Spectrum direct(0.0f);
        for (const IncomingLight& light : incoming)
            direct += light.irradiance * directional_albedo(brdf, light.direction.z) /
                      std::numbers::pi_v<float>;
        for (int c = 0; c < channel_count; ++c)
            EXPECT_NEAR(solution.direct_radiance(0)[c], direct[c], 1e-5f * direct[c]);
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
