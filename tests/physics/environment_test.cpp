// Light from outside the scene.
#include "physics/transport_runs.h"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

Environment uniform_sky(float radiance) {
    Environment e;
    e.kind = Environment::Kind::uniform;
    e.radiance_scale = Spectrum(radiance);
    return e;
}

double largest_deviation(const TransportRun& run, double expected) {
    double largest = 0.0;
    for (std::uint32_t p = 0; p < run.patches.leaf_count; ++p)
        largest = std::max(largest, std::abs(run.radiance(p) - expected));
    return largest;
}

// All that a convex solid sees is the sky; the ratio estimator then is exact.
TEST(UniformSky, LightsAConvexSolidAlike) {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 2, 0.5}, Facing::outwards, b.material(Spectrum(0.7f)));
    b.scene.lighting.environment = uniform_sky(2.0f);
    const TransportRun run = run_transport(b.scene, {.directions = 64});
    EXPECT_LT(largest_deviation(run, 1.4), 1e-5);
}

// Le = 1 - albedo under a sky of 1 is a furnace, also for what is not convex.
TEST(UniformSky, MakesAFurnaceOfAnOpenScene) {
    SceneBuilder b;
    const std::uint32_t grey = b.material(Spectrum(0.6f), Spectrum(0.4f));
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, grey, 1);
    b.scene.lighting.environment = uniform_sky(1.0f);
    b.scene.materials[grey].back_emits = true;
    const TransportRun run = run_transport(b.scene, {});
    EXPECT_LT(largest_deviation(run, 1.0), 1e-4);
}

// Without emission, its flux balance: what comes in is absorbed or leaves again.
TEST(UniformSky, IsAbsorbedOrLeavesAgain) {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, b.material(Spectrum(0.8f)), 1);
    b.scene.lighting.environment = uniform_sky(1.0f);
    const TransportRun run = run_transport(b.scene, {.directions = 1024});
    double absorbed = 0.0;
    for (std::uint32_t p = 0; p < run.patches.patch_count(); ++p)
        absorbed += 0.2 * run.result.irradiance[p].x *
                    area_of_leaf(run.surface, run.patches, run.patches.leaf_of_patch(p));
    EXPECT_NEAR(absorbed + run.result.escaped.x, run.result.entered.x, 5e-3 * run.result.entered.x);
    // Five squares from outside, one opening: each side's projected area is half of the front's.
    EXPECT_NEAR(run.result.entered.x, 6.0 * std::numbers::pi, 0.01 * 6.0 * std::numbers::pi);
}

// Validation A5.
TEST(UniformSky, DoesNotEnterAClosedBox) {
    for (const double wall : {0.0, 0.01, 0.1}) {
        SceneBuilder b;
        b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, b.material(Spectrum(0.8f)));
        if (wall > 0.0)
            b.box(glm::dvec3(-wall), glm::dvec3(1 + wall), Facing::outwards,
                  b.material(Spectrum(0.8f)));
        for (Material& m : b.scene.materials) m.back_reflects = false;
        b.scene.lighting.environment = uniform_sky(1.0f);
        const TransportRun run = run_transport(b.scene, {});
        for (std::uint32_t p = 0; p < run.patches.leaf_count; ++p) {
            const bool inside = run.surface.triangles[run.patches.root_of_leaf[p]].source_face < 6;
            if (!inside) continue;
            ASSERT_EQ(run.result.irradiance[p], Spectrum(0.0f)) << wall;
        }
    }
}

// Validation F: horizontal 7 pi Lz / 9, vertical 0.396177 of that.
TEST(OvercastSky, LightsGroundAndWallsAsItShould) {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::outwards, b.material(Spectrum(0.0f)));
    Environment& sky = b.scene.lighting.environment;
    sky.kind = Environment::Kind::overcast;
    sky.up = {0, 0, 1};
    const TransportRun run = run_transport(b.scene, {.directions = 4096, .leaves = 12});
    const double horizontal = 7.0 * std::numbers::pi / 9.0;
    for (std::uint32_t p = 0; p < run.patches.leaf_count; ++p) {
        const glm::dvec3 n = normal_of(run.surface, run.patches.root_of_leaf[p]);
        const double expected = n.z > 0.5 ? horizontal : n.z < -0.5 ? 0.0 : 0.396177 * horizontal;
        EXPECT_NEAR(run.result.irradiance[p].x, expected, 0.01 * horizontal);
    }
}

}  // namespace
