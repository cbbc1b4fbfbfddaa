// Identities that hold in any closed scene.
#include "physics/transport_runs.h"
#include "support/random_hierarchy.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

double largest_deviation_from_one(const TransportRun& run) {
    double largest = 0.0;
    for (std::uint32_t p = 0; p < run.patches.leaf_count; ++p)
        largest = std::max(largest, std::abs(run.radiance(p) - 1.0));
    return largest;
}

class Furnace : public testing::TestWithParam<float> {};

TEST_P(Furnace, OfACubeIsOneEverywhere) {
    const float rho = GetParam();
    EXPECT_LT(largest_deviation_from_one(run_transport(cube_scene(rho, 1 - rho, 1 - rho), {})),
              1e-4);
}

TEST_P(Furnace, OfASphereIsOneEverywhere) {
    const float rho = GetParam();
    SceneBuilder b;
    b.sphere({0, 0, 0}, 1.0, 32, Facing::inwards, b.material(Spectrum(rho), Spectrum(1 - rho)));
    EXPECT_LT(largest_deviation_from_one(run_transport(b.scene, {})), 1e-4);
}

TEST_P(Furnace, OfLeavesOfSeveralLevelsIsOneEverywhere) {
    const float rho = GetParam();
    Monitor silent;
    const SurfaceMesh cube = build_surface(cube_scene(rho, 1 - rho, 1 - rho), {}, silent);
    const PatchHierarchy mixed = random_hierarchy(std::vector<int>(12, 2), 2, 1);
    ASSERT_EQ(mixed.mixed_roots.size(), 12u);
    EXPECT_LT(largest_deviation_from_one(run_transport(cube, mixed, {})), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Albedos, Furnace, testing::Values(0.5f, 0.95f));

// Le = 1 - a makes L = 1 for any shape and any albedos, also on a mesh whose triangles meet only in
// part.
TEST(ManufacturedSolution, HoldsForDifferentAlbedosAndTJunctions) {
    SceneBuilder b;
    const auto material = [&](float rho) { return b.material(Spectrum(rho), Spectrum(1 - rho)); };
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, material(0.3f), 0);
    b.polygon({{0, 0, 0}, {0.4, 0, 0}, {0.4, 1, 0}, {0, 1, 0}}, material(0.9f));
    b.polygon({{0.4, 0, 0}, {1, 0, 0}, {1, 0.7, 0}, {0.4, 0.7, 0}}, material(0.6f));
    b.polygon({{0.4, 0.7, 0}, {1, 0.7, 0}, {1, 1, 0}, {0.4, 1, 0}}, material(0.1f));
    EXPECT_LT(largest_deviation_from_one(run_transport(b.scene, {.directions = 1024})), 1e-3);
}

struct MeanCase {
    float albedo;
    std::uint64_t directions;
    double tolerance;
};
class MeanIrradiance : public testing::TestWithParam<MeanCase> {};

// <E> = Phi / (S (1 - rho)): the floor is a sixth of the surface, Phi = pi.
TEST_P(MeanIrradiance, FollowsFromTheFlux) {
    const auto [rho, directions, tolerance] = GetParam();
    for (const std::uint64_t seed : {1, 2, 3}) {
        const TransportRun run =
            run_transport(cube_scene(rho, 1.0f, 0.0f), {.directions = directions, .seed = seed});
        EXPECT_NEAR(run.mean_incoming(all_fronts) * 6.0 * (1.0 - rho), 1.0, tolerance)
            << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Albedos, MeanIrradiance,
                         testing::Values(MeanCase{0.2f, 256, 5e-3}, MeanCase{0.5f, 256, 5e-3},
                                         MeanCase{0.8f, 256, 5e-3}, MeanCase{0.9f, 256, 5e-3},
                                         MeanCase{0.2f, 1024, 1e-3}, MeanCase{0.5f, 1024, 1e-3},
                                         MeanCase{0.8f, 1024, 1e-3}, MeanCase{0.9f, 1024, 1e-3}));

// What the balance is for: the 1/m average forgets its start only as m^-(1 - a).
TEST(PaperAveraging, FallsShortAtHighAlbedo) {
    const TransportRun run =
        run_transport(cube_scene(0.9f, 1.0f, 0.0f), {.averaging = Averaging::paper});
    EXPECT_LT(run.mean_incoming(all_fronts) * 0.6, 0.9);
    const TransportRun mild =
        run_transport(cube_scene(0.2f, 1.0f, 0.0f), {.averaging = Averaging::paper});
    EXPECT_NEAR(mild.mean_incoming(all_fronts) * 4.8, 1.0, 0.03);
}

TEST(TwoRooms, FarRoomConvergesFast) {
    const auto far_mean = [](std::uint64_t directions) {
        const TransportRun run = run_transport(two_rooms_scene(0.8f), {.directions = directions});
        return run.mean_incoming([&](std::uint32_t root, bool back) {
            return !back && is_in_far_room(run.surface, root);
        });
    };
    EXPECT_NEAR(far_mean(256) / far_mean(4096), 1.0, 0.03);
}

/// A box with walls of some thickness in a luminous one.
Scene sealed_box(double thickness) {
    SceneBuilder b;
    const std::uint32_t white = b.material(Spectrum(0.7f));
    b.box({-1, -1, -1}, {2, 2, 2}, Facing::inwards, b.material(Spectrum(0.5f), Spectrum(1.0f)));
    b.box({0, 0, 0}, {1, 1, 1}, thickness > 0.0 ? Facing::inwards : Facing::outwards, white);
    const glm::dvec3 t(thickness);
    if (thickness > 0.0) b.box(-t, glm::dvec3(1) + t, Facing::outwards, white);
    return b.scene;
}

class Leak : public testing::TestWithParam<double> {};

TEST_P(Leak, NothingEntersASealedBox) {
    const double thickness = GetParam();
    const TransportRun run = run_transport(sealed_box(thickness), {.directions = 512});
    const bool inside_is_back = thickness == 0.0;
    std::uint32_t inside = 0;
    for (std::uint32_t p = 0; p < run.patches.patch_count(); ++p) {
        const std::uint32_t root = run.patches.root_of_leaf[run.patches.leaf_of_patch(p)];
        if (root < 12 || root >= 24 || run.patches.is_back(p) != inside_is_back) continue;
        EXPECT_EQ(run.result.irradiance[p], Spectrum(0.0f)) << "root " << root;
        ++inside;
    }
    EXPECT_GT(inside, 12u);
    EXPECT_EQ(run.result.escaped, SpectrumSum(0.0));
}

INSTANTIATE_TEST_SUITE_P(Thicknesses, Leak, testing::Values(0.0, 1e-3, 1e-2, 0.1));

TEST(Darkness, WithoutEmittersIsExact) {
    const TransportRun run = run_transport(cube_scene(0.9f, 0.0f, 0.0f), {.directions = 64});
    for (const Spectrum& e : run.result.irradiance) EXPECT_EQ(e, Spectrum(0.0f));
    EXPECT_EQ(run.result.relative_error, 0.0);
}

TEST(WhiteScene, ThatNeverFadesIsRefused) {
    EXPECT_THROW((void)run_transport(cube_scene(1.0f, 1.0f, 0.0f), {.directions = 64}), UsageError);
    EXPECT_NO_THROW((void)run_transport(cube_scene(0.999f, 1.0f, 0.0f), {.directions = 64}));
}

}  // namespace
