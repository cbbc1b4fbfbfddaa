#include "support/closed_forms.h"
#include "support/scene_builder.h"

#include <transillum/first_shot/shoot_direct_light.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>

namespace transillum {
namespace {

using namespace testing_support;
constexpr double pi = std::numbers::pi;

struct Lit {
    SurfaceMesh mesh;
    PatchHierarchy patches;
    DirectLight light;
    std::vector<Spectrum> irradiance;
};

struct Shot {
    int level = 3, samples = 64, resolution = 128, threads = 2;
    std::uint64_t seed = 1;
};

Lit shoot(const SceneBuilder& builder, const Shot& shot) {
    Lit lit;
    lit.mesh = builder.surface();
    lit.patches = subdivide_to_levels(std::vector<int>(lit.mesh.triangles.size(), shot.level));
    const Luminaires luminaires = sample_luminaires(
        lit.mesh, {.first_shot = FirstShot::hemicube, .samples = shot.samples, .seed = shot.seed});
    Monitor silent;
    lit.light = shoot_direct_light(lit.mesh, lit.patches, luminaires, shot.resolution,
                                   Workers(shot.threads), silent);
    lit.irradiance = direct_irradiance(lit.light, lit.patches.patch_count());
    return lit;
}

/// Flux that arrives, over patches of a polygon, or of all.
glm::dvec3 arriving_flux(const Lit& lit, int polygon = -1) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t p = 0; p < lit.patches.patch_count(); ++p) {
        const std::uint32_t root = lit.patches.root_of_leaf[lit.patches.leaf_of_patch(p)];
        if (polygon < 0 ||
            lit.mesh.triangles[root].source_face == static_cast<std::uint32_t>(polygon))
            sum += area_of_leaf(lit.mesh, lit.patches, lit.patches.leaf_of_patch(p)) *
                   glm::dvec3(lit.irradiance[p]);
    }
    return sum;
}

const Outline lamp_outline{{-0.1, -0.1, 1}, {-0.1, 0.1, 1}, {0.1, 0.1, 1}, {0.1, -0.1, 1}};
const Spectrum radiance(10.0f, 5.0f, 0.0f);

/// A floor of 2 x 2 under a small lamp at height 1.
SceneBuilder floor_under_lamp(double scale = 1.0) {
    SceneBuilder builder;
    builder.polygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    builder.polygon(lamp_outline, builder.material(Spectrum(0.0f), radiance));
    for (glm::dvec3& p : builder.scene.positions) p *= scale;
    return builder;
}

/// Mean over a leaf of the closed form, by the midpoints of 64 parts.
double mean_irradiance(const Lit& lit, std::uint32_t leaf) {
    const std::uint32_t root = lit.patches.root_of_leaf[leaf];
    const auto [c, level] = leaf_corners(lit.patches, leaf);
    const PatchHierarchy parts = subdivide_to_levels({3});
    double sum = 0.0;
    for (std::uint32_t part = 0; part < parts.leaf_count; ++part) {
        glm::dvec3 point(0.0);
        for (const glm::ivec2& b : leaf_corners(parts, part).b) {
            const glm::ivec2 fine = 8 * c[0] + b.x * (c[1] - c[0]) + b.y * (c[2] - c[0]);
            point += point_of_root(lit.mesh, root, fine, level + 3) / 3.0;
        }
        sum += polygon_irradiance(lamp_outline, point, {0, 0, 1}) / parts.leaf_count;
    }
    return sum;
}

TEST(DirectIrradiance, OfAFloorUnderALampAgreesWithTheClosedForm) {
    constexpr int replicates = 8;
    std::vector<Lit> lit;
    for (std::uint64_t seed = 1; seed <= replicates; ++seed)
        lit.push_back(shoot(floor_under_lamp(),
                            {.level = 3, .samples = 64, .resolution = 256, .seed = seed}));
    double worst = 0.0, error = 0.0, floor_leaves = 0.0, total = 0.0, expected_total = 0.0;
    for (std::uint32_t leaf = 0; leaf < lit[0].patches.leaf_count; ++leaf) {
        if (lit[0].mesh.triangles[lit[0].patches.root_of_leaf[leaf]].source_face != 0) continue;
        const double expected = mean_irradiance(lit[0], leaf);
        std::vector<double> values;
        for (const Lit& l : lit) values.push_back(l.irradiance[leaf].y / 5.0);
        const Estimate e = estimate(values);
        worst = std::max(worst, std::abs(e.mean / expected - 1.0));
        error += e.error / expected;
        total += e.mean;
        expected_total += expected;
        floor_leaves += 1.0;
    }
    ASSERT_EQ(floor_leaves, 128.0);
    // Six standard errors for the worst of 128 leaves, one for the whole floor, where they cancel.
    error /= floor_leaves;
    EXPECT_LT(error, 0.001);
    EXPECT_LT(worst, 6.0 * error);
    EXPECT_NEAR(total / expected_total, 1.0, error);
    for (std::uint32_t leaf = 0; leaf < lit[0].patches.leaf_count; ++leaf) {
        const Spectrum e = lit[0].irradiance[leaf];
        EXPECT_FLOAT_EQ(e.x, 2.0f * e.y);
        EXPECT_EQ(e.z, 0.0f);
        EXPECT_EQ(lit[0].irradiance[lit[0].patches.leaf_count + leaf], Spectrum(0.0f))
            << "a back was lit";
    }
}

/// All that leaves the lamp arrives somewhere: pi L A.
TEST(DirectIrradiance, InAClosedBoxNoFluxIsLost) {
    SceneBuilder builder;
    builder.box({-1, -1, 0}, {1, 1, 1.5}, Facing::inwards);
    builder.polygon(lamp_outline, builder.material(Spectrum(0.0f), radiance));
    const glm::dvec3 expected = pi * 0.04 * glm::dvec3(radiance);
    const glm::dvec3 flux = arriving_flux(shoot(builder, {.samples = 16}));
    EXPECT_NEAR(flux.x, expected.x, 1e-3 * expected.x);
    EXPECT_NEAR(flux.y, expected.y, 1e-3 * expected.y);
    EXPECT_EQ(flux.z, 0.0);
}

/// A board covers the lamp so closely that what a sample sends lands on a leaf or two, several
/// times what fills them. None of it belongs past the board.
TEST(DirectIrradiance, NothingPassesAScreenCloseToTheLamp) {
    SceneBuilder builder;
    builder.box({-1, -1, 0}, {1, 1, 1.5}, Facing::inwards);
    builder.polygon(lamp_outline, builder.material(Spectrum(0.0f), radiance));
    constexpr double gap = 0.001, overhang = 0.1;
    const double z = 1.0 - gap;
    builder.polygon({{-0.2, -0.2, z}, {0.2, -0.2, z}, {0.2, 0.2, z}, {-0.2, 0.2, z}});
    const double whole = pi * 0.04 * 10.0;
    for (const int samples : {16, 64})
        for (const int level : {4, 6}) {
            const Lit lit = shoot(builder, {.level = level, .samples = samples});
            EXPECT_NEAR(arriving_flux(lit).x, whole, 1e-3 * whole);
            // A point sends what leaves it lower than the board's edge, of which the square of the
            // angle's sine is a share.
            const double past = (arriving_flux(lit).x - arriving_flux(lit, 7).x) / whole;
            EXPECT_LT(past, gap * gap / (overhang * overhang)) << samples << ", " << level;
        }
}

TEST(DirectIrradiance, ABulbLightsTheBoxAroundIt) {
    SceneBuilder builder;
    builder.box({-1, -1, -1}, {1, 1, 1}, Facing::inwards);
    builder.sphere({0, 0, 0}, 0.1, 16, Facing::outwards,
                   builder.material(Spectrum(0.0f), radiance));
    const Lit lit = shoot(builder, {.samples = 256, .resolution = 64});
    double area = 0.0;
    for (const LightSample& s : lit.light.samples) area += s.area;
    EXPECT_NEAR(arriving_flux(lit).x, pi * area * 10.0, 1e-3 * pi * area * 10.0);
    // By symmetry a sixth each; 256 normals strewn at random would be off by 4 %.
    for (int face = 0; face < 6; ++face)
        EXPECT_NEAR(arriving_flux(lit, face).x / arriving_flux(lit).x, 1.0 / 6.0, 0.04 / 6.0);
}

TEST(DirectIrradiance, BothSidesOfASheetShine) {
    SceneBuilder builder;
    builder.box({-1, -1, 0}, {1, 1, 2}, Facing::inwards);
    const std::uint32_t m = builder.material(Spectrum(0.0f), radiance);
    builder.scene.materials[m].back_emits = true;
    builder.polygon(lamp_outline, m);
    const Lit lit = shoot(builder, {.samples = 64});
    EXPECT_NEAR(arriving_flux(lit).x, 2.0 * pi * 0.4, 2e-3 * pi * 0.4);
    // It hangs half way up: floor and ceiling get alike, but for 64 samples' spread over the lamp.
    EXPECT_NEAR(arriving_flux(lit, 0).x / arriving_flux(lit, 1).x, 1.0, 0.01);
}

TEST(DirectIrradiance, AScreenCastsItsShadow) {
    SceneBuilder builder = floor_under_lamp();
    builder.polygon({{-1, -1, 0.01}, {0, -1, 0.01}, {0, 1, 0.01}, {-1, 1, 0.01}});
    const Lit lit = shoot(builder, {.level = 3, .samples = 16});
    for (std::uint32_t leaf = 0; leaf < lit.patches.leaf_count; ++leaf) {
        const std::uint32_t root = lit.patches.root_of_leaf[leaf];
        if (lit.mesh.triangles[root].source_face != 0) continue;
        double low = 1.0, high = -1.0;
        for (const glm::dvec3& p : points_of_leaf(lit.mesh, lit.patches, leaf)) {
            low = std::min(low, p.x);
            high = std::max(high, p.x);
        }
        const bool hidden = high<-0.05, open = low> 0.05;
        EXPECT_TRUE(!hidden || lit.irradiance[leaf].x == 0.0f);
        EXPECT_TRUE(!open || lit.irradiance[leaf].x > 0.0f);
    }
}

TEST(ShootDirectLight, DoesNotDependOnTheNumberOfWorkers) {
    SceneBuilder builder;
    builder.box({-1, -1, 0}, {1, 1, 1.5}, Facing::inwards);
    builder.sphere({0.3, 0.2, 0.5}, 0.2, 16, Facing::outwards);
    builder.polygon(lamp_outline, builder.material(Spectrum(0.0f), radiance));
    const Lit one = shoot(builder, {.level = 2, .samples = 32, .resolution = 64, .threads = 1});
    for (const int threads : {2, 8}) {
        const Lit many =
            shoot(builder, {.level = 2, .samples = 32, .resolution = 64, .threads = threads});
        EXPECT_EQ(one.light.geometry_factor, many.light.geometry_factor);
        EXPECT_EQ(one.light.visibility, many.light.visibility);
        EXPECT_EQ(one.irradiance, many.irradiance);
    }
}

TEST(ShootDirectLight, ScaleDoesNotMatter) {
    const Lit unit = shoot(floor_under_lamp(), {.samples = 16, .resolution = 64});
    // A power of two changes no digit.
    const Lit binary = shoot(floor_under_lamp(0x1p10), {.samples = 16, .resolution = 64});
    EXPECT_EQ(unit.irradiance, binary.irradiance);
    // Else corners move by 2^-40 of the scene, and here and there a fixed-point coordinate by 1/256
    // pixel.
    const Lit decimal = shoot(floor_under_lamp(1e3), {.samples = 16, .resolution = 64});
    ASSERT_EQ(unit.irradiance.size(), decimal.irradiance.size());
    for (std::size_t p = 0; p < unit.irradiance.size(); ++p)
        EXPECT_NEAR(unit.irradiance[p].x, decimal.irradiance[p].x, 1e-3f * unit.irradiance[p].x);
    EXPECT_NEAR(arriving_flux(decimal).x / arriving_flux(unit).x, 1e6, 1e2);
}

TEST(ShootDirectLight, CountsEverySampleOnce) {
    class Counter : public Monitor {
    public:
        void progress(const Progress& p) override { steps.push_back(p.done), total = p.total; }
        std::vector<std::uint64_t> steps;
        std::uint64_t total = 0;
    } counter;
    const SceneBuilder builder = floor_under_lamp();
    const SurfaceMesh mesh = builder.surface();
    const PatchHierarchy patches = subdivide_to_levels(std::vector<int>(mesh.triangles.size(), 0));
    const Luminaires luminaires = sample_luminaires(mesh, {.samples = 10});
    (void)shoot_direct_light(mesh, patches, luminaires, 16, Workers(2), counter);
    ASSERT_EQ(counter.steps.size(), 10u);
    for (std::uint64_t i = 0; i < 10; ++i) EXPECT_EQ(counter.steps[i], i + 1);
    EXPECT_EQ(counter.total, 10u);
}

TEST(ShootDirectLight, NoSamplesGiveNoLight) {
    SceneBuilder builder;
    builder.box({-1, -1, 0}, {1, 1, 1.5}, Facing::inwards);
    const Lit lit = shoot(builder, {});
    EXPECT_TRUE(lit.light.geometry_factor.empty());
    for (const Spectrum& e : lit.irradiance) EXPECT_EQ(e, Spectrum(0.0f));
}

}  // namespace
}  // namespace transillum
