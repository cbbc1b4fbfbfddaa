// Transport in bands of wavelengths: closed forms band by band, and the agreement with RGB.
#include "support/metamers.h"
#include "support/scene_builder.h"

#include <transillum/solution/bake_bands.h>

#include <gtest/gtest.h>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

BakeOptions coarse(std::uint32_t leaves = 600) {
    BakeOptions options;
    options.subdivision.leaf_target = leaves;
    options.iteration.iterations = 64;
    options.resolution = 128;
    options.hemicube_resolution = 64;
    return options;
}

MeasuredMaterial measured(const char* name, SpectrumTable reflectance) {
    return {name, std::move(reflectance), {}, {}, {}};
}

SpectralSolution bake_it(const Scene& scene, const SpectralOptions& spectral,
                         const BakeOptions& options = coarse(), int threads = 2) {
    Monitor silent;
    return bake_bands(scene, spectral, options, Workers(threads), silent);
}

/// A closed room, fronts inwards, whose walls are all of one material.
SceneBuilder room(const Spectrum& diffuse, const Spectrum& emission) {
    SceneBuilder b;
    const std::uint32_t m = b.material(diffuse, emission);
    b.scene.materials[m].name = "wall";
    b.scene.materials[m].back_reflects = false;
    b.box({0, 0, 0}, {1, 1.5, 0.7}, Facing::inwards, m);
    return b;
}

/// The same, with a small square lamp below the ceiling.
SceneBuilder room_with_lamp(const Spectrum& diffuse) {
    SceneBuilder b = room(diffuse, Spectrum(0.0f));
    const std::uint32_t lamp = b.material(Spectrum(0.0f), Spectrum(20.0f));
    b.scene.materials[lamp].name = "lamp";
    b.polygon({{0.4, 0.6, 0.69}, {0.4, 0.8, 0.69}, {0.6, 0.8, 0.69}, {0.6, 0.6, 0.69}}, lamp);
    return b;
}

float radiance(const Solution& s, std::uint32_t patch, int channel) {
    return (s.emission(patch) + s.direct_radiance(patch) +
            s.finite_element_radiance(patch))[channel];
}

// What a wall absorbs of each wavelength, it emits: L = 1 in every band.
TEST(Bands, FurnaceIsOneInEveryBand) {
    const SpectrumTable reflects =
        table_of("reflects", [](double nm) { return (nm - 380.0) / 360.0; });
    const SpectrumTable emits =
        table_of("emits", [](double nm) { return 1.0 - (nm - 380.0) / 360.0; });
    SpectralOptions spectral{10, {}, 0.99f};
    spectral.measured = {{"wall", reflects, {}, emits, 1.0}};
    const SpectralSolution baked = bake_it(room(Spectrum(0.5f), Spectrum(0.5f)).scene, spectral);
    for (int g = 0; g < Bands(10).groups(); ++g) {
        const Solution s = solution_of_group(baked, g);
        for (std::uint32_t p = 0; p < s.patches.leaf_count; ++p)
            for (int c = 0; c < channel_count; ++c)
                ASSERT_NEAR(radiance(s, p, c), 1.0f, 1e-4f) << g << ' ' << c;
    }
    for (std::uint32_t p = 0; p < baked.rgb.patches.leaf_count; ++p)
        for (int c = 0; c < channel_count; ++c)
            ASSERT_NEAR(baked.rgb.indirect_irradiance[p][c], 3.14159265f, 1e-3f);
}

// Channels don't know of each other, so that a grey scene takes the same way in each.
TEST(Bands, OfAGreySceneAreAsRgb) {
    const Scene scene = room_with_lamp(Spectrum(0.7f)).scene;
    Monitor silent;
    const Solution rgb = bake(scene, coarse(), Workers(2), silent);
    const SpectralSolution bands = bake_it(scene, {12, {}, 0.99f});
    ASSERT_GT(rgb.direct.samples.size(), 0u);
    ASSERT_EQ(rgb.patches.patch_count(), bands.rgb.patches.patch_count());
    const auto same = [&](const std::vector<Spectrum>& a, const std::vector<Spectrum>& b) {
        for (std::size_t p = 0; p < a.size(); ++p)
            for (int c = 0; c < channel_count; ++c)
                ASSERT_NEAR(a[p][c], b[p][c], 2e-6f * (1e-3f + b[p][c])) << p;
    };
    same(bands.rgb.direct_irradiance, rgb.direct_irradiance);
    same(bands.rgb.indirect_irradiance, rgb.indirect_irradiance);
    same(bands.rgb.standard_error, rgb.standard_error);
    EXPECT_EQ(bands.rgb.coverage, rgb.coverage);
    EXPECT_EQ(bands.rgb.iterations, rgb.iterations);
    EXPECT_NEAR(bands.rgb.balance.absorbed.y, rgb.balance.absorbed.y,
                1e-5 * rgb.balance.absorbed.y);
    for (const BandGroup& g : bands.groups) same(g.indirect_irradiance, rgb.indirect_irradiance);
}

// Walls that emit 1 and reflect rho make L = 1 / (1 - rho) of every band. Metamers agree in what is
// reflected once, 1 + rho, and in no more.
TEST(Bands, TellMetamersApartByInterreflection) {
    const Bands bands(12);
    const auto [flat, bumpy] = grey_metamers(bands);
    ASSERT_LT(glm::distance(bands.rgb_of(flat), bands.rgb_of(bumpy)), 1e-6);
    const SpectrumTable one = table_of("one", [](double) { return 1.0; });
    SpectrumSum expected(0.0), found(0.0);
    const SpectralSolution baked = bake_it(room(Spectrum(0.5f), Spectrum(1.0f)).scene,
                                           {12, {{"wall", bumpy, {}, one, 1.0}}, 0.99f});
    for (int g = 0; g < bands.groups(); ++g) {
        const Solution s = solution_of_group(baked, g);
        const Spectrum rho = bands.in_group(bumpy, g);
        const SpectrumSum closed = 1.0 / (1.0 - SpectrumSum(rho));
        for (int c = 0; c < channel_count; ++c)
            ASSERT_NEAR(radiance(s, 0, c), closed[c], 1e-3 * closed[c]);
        expected += bands.rgb_from_group(g) * closed;
        found +=
            bands.rgb_from_group(g) * SpectrumSum(s.emission(0) + s.finite_element_radiance(0));
    }
    EXPECT_LT(glm::distance(found, expected), 1e-2);
    // Of the flat one, 2 in every band and channel: told apart by far more than the error above.
    EXPECT_GT(glm::distance(expected, SpectrumSum(2.0)), 0.3);
}

// RGB light between RGB surfaces: alike but for what interreflection does to smooth spectra. Where
// light is reflected but once from a surface under white light, it is the same.
TEST(Bands, OfColouredDirectLightAreAsRgb) {
    const Scene scene = room_with_lamp({0.6f, 0.3f, 0.2f}).scene;
    Monitor silent;
    const Solution rgb = bake(scene, coarse(), Workers(2), silent);
    const SpectralSolution baked = bake_it(scene, {12, {}, 0.99f});
    const Bands bands(12);
    std::vector<SpectrumSum> direct(rgb.patches.patch_count(), SpectrumSum(0.0));
    for (int g = 0; g < bands.groups(); ++g) {
        const Solution s = solution_of_group(baked, g);
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p)
            direct[p] += bands.rgb_from_group(g) * SpectrumSum(s.direct_radiance(p));
    }
    for (std::uint32_t p = 0; p < rgb.patches.patch_count(); ++p)
        ASSERT_LT(glm::distance(direct[p], SpectrumSum(rgb.direct_radiance(p))),
                  1e-5 * (1e-3 + glm::length(direct[p])));
}

// A lamp without any blue, walls without any red: groups of bands that stay dark.
TEST(Bands, MayBeDark) {
    const Scene scene = room_with_lamp(Spectrum(0.5f)).scene;
    const SpectrumTable red = table_of("red", [](double nm) { return nm > 600.0 ? 1.0 : 0.0; });
    const SpectrumTable blue = table_of("blue", [](double nm) { return nm < 450.0 ? 0.8 : 0.0; });
    SpectralOptions spectral{12, {{"lamp", {}, {}, red, {}}}, 0.99f};
    SpectralSolution baked = bake_it(scene, spectral);
    for (std::uint32_t p = 0; p < baked.rgb.patches.leaf_count; ++p) {
        EXPECT_EQ(baked.groups[0].direct_irradiance[p], Spectrum(0.0f));
        EXPECT_EQ(baked.groups[1].indirect_irradiance[p], Spectrum(0.0f));
    }
    EXPECT_EQ(baked.rgb.iterations, 64u);
    EXPECT_NEAR(luminance(solution_of_group(baked, 0).material_of(0).diffuse), 0.5f, 1e-6f);
    spectral.measured.push_back(measured("wall", blue));
    baked = bake_it(scene, spectral);
    EXPECT_EQ(baked.rgb.iterations, 0u);
    for (const BandGroup& g : baked.groups)
        for (const Spectrum& e : g.indirect_irradiance) EXPECT_EQ(e, Spectrum(0.0f));
    EXPECT_TRUE(std::ranges::any_of(baked.rgb.decisions,
                                    [](const Decision& d) { return d.what == "no iteration"; }));
}

// Glossy walls whose lobe is red: all groups have the same bins.
TEST(Bands, KeepLobesInEveryGroup) {
    SceneBuilder b = room_with_lamp(Spectrum(0.3f));
    b.scene.materials[1].lobe = Lobe::max_phong;
    b.scene.materials[1].specular = {0.5f, 0.0f, 0.0f};
    b.scene.materials[1].shininess = 10.0f;
    const SpectralSolution baked = bake_it(b.scene, {8, {}, 0.99f}, coarse(200));
    ASSERT_FALSE(baked.rgb.glossy.empty());
    for (int g = 0; g < 3; ++g) {
        const Solution s = solution_of_group(baked, g);
        EXPECT_EQ(s.glossy.of_root_side, baked.rgb.glossy.of_root_side);
        EXPECT_EQ(s.glossy.element_count, baked.rgb.glossy.element_count);
        EXPECT_EQ(s.glossy_elements.size(), s.glossy.element_count);
        for (const GlossySide& side : s.glossy.sides)
            EXPECT_NE(s.glossy.brdfs[side.brdf].lobe, Lobe::none);
    }
}

TEST(Bands, DoNotDependOnTheNumberOfThreads) {
    const Scene scene = room_with_lamp({0.6f, 0.3f, 0.2f}).scene;
    BakeOptions options = coarse(200);
    options.refinement.phases = 1;
    const SpectralSolution one = bake_it(scene, {8, {}, 0.99f}, options, 1),
                           three = bake_it(scene, {8, {}, 0.99f}, options, 3);
    EXPECT_TRUE(one.rgb.patches == three.rgb.patches);
    for (std::size_t g = 0; g < one.groups.size(); ++g) {
        EXPECT_EQ(one.groups[g].direct_irradiance, three.groups[g].direct_irradiance);
        EXPECT_EQ(one.groups[g].indirect_irradiance, three.groups[g].indirect_irradiance);
        EXPECT_EQ(one.groups[g].standard_error, three.groups[g].standard_error);
    }
}

/// Wants to stop in the second group.
class Impatient : public Monitor {
public:
    void progress(const Progress& p) override {
        const std::string phase(p.phase);
        if (phase.find("transport") != std::string::npos && !phase.starts_with("400 "))
            stop_ = true;
    }
    void warn(const std::string& message) override { warnings.push_back(message); }
    [[nodiscard]] bool stop_requested() const override { return stop_; }
    std::vector<std::string> warnings;

private:
    bool stop_ = false;
};

TEST(Bands, StoppedEarlyAreStillASolution) {
    Impatient monitor;
    const SpectralSolution baked =
        bake_bands(room_with_lamp(Spectrum(0.7f)).scene, {}, coarse(), Workers(2), monitor);
    EXPECT_TRUE(baked.rgb.interrupted);
    EXPECT_EQ(baked.groups.size(), 4u);
    ASSERT_FALSE(monitor.warnings.empty());
    EXPECT_NE(monitor.warnings.back().find("interrupted"), std::string::npos);
    EXPECT_EQ(baked.groups[0].direct_irradiance, baked.groups[3].direct_irradiance);
}

}  // namespace
