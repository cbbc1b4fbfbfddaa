// What must not change a solution, and what must change it in a known way.
#include "physics/transport_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

Scene lit_cube() {
    return cube_scene(0.6f, 1.0f, 0.0f);
}

TEST(Invariance, ResultDoesNotDependOnTheThreads) {
    const TransportRun one =
        run_transport(two_rooms_scene(0.8f), {.directions = 100, .threads = 1});
    for (const int threads : {2, 8}) {
        const TransportRun many =
            run_transport(two_rooms_scene(0.8f), {.directions = 100, .threads = threads});
        EXPECT_EQ(one.result.irradiance, many.result.irradiance) << threads << " threads";
        EXPECT_EQ(one.result.standard_error, many.result.standard_error) << threads << " threads";
        EXPECT_EQ(one.result.coverage, many.result.coverage) << threads << " threads";
    }
}

TEST(Invariance, TwiceTheEmissionIsTwiceTheLightToTheLastBit) {
    const TransportRun once = run_transport(lit_cube(), {});
    const TransportRun twice = run_transport(cube_scene(0.6f, 2.0f, 0.0f), {});
    for (std::uint32_t p = 0; p < once.patches.patch_count(); ++p)
        EXPECT_EQ(2.0f * once.result.irradiance[p], twice.result.irradiance[p]);
}

TEST(Invariance, LightsAddUp) {
    const TransportRun floor = run_transport(cube_scene(0.6f, 1.0f, 0.0f), {.directions = 1024});
    const TransportRun others = run_transport(cube_scene(0.6f, 0.0f, 0.3f), {.directions = 1024});
    const TransportRun both = run_transport(cube_scene(0.6f, 1.0f, 0.3f), {.directions = 1024});
    EXPECT_NEAR(both.mean_incoming(all_fronts),
                floor.mean_incoming(all_fronts) + others.mean_incoming(all_fronts),
                1e-3 * both.mean_incoming(all_fronts));
}

class Moved : public testing::TestWithParam<std::pair<double, double>> {};  // scale, shift in sizes

TEST_P(Moved, SceneKeepsItsLight) {
    const auto [scale, shift] = GetParam();
    Scene scene = lit_cube();
    for (glm::dvec3& p : scene.positions) p = (p + shift) * scale;
    const TransportRun moved = run_transport(scene, {.directions = 1024});
    EXPECT_NEAR(moved.mean_incoming(all_fronts) * 6.0 * 0.4, 1.0, 1e-3);
    EXPECT_LE(moved.surface.grid.largest_move, std::ldexp(1.0, moved.surface.grid.exponent));
}

INSTANTIATE_TEST_SUITE_P(ScalesAndShifts, Moved,
                         testing::Values(std::pair{1e-3, 0.0}, std::pair{1e3, 0.0},
                                         std::pair{1.0, 1e6}, std::pair{1e3, -1e6}));

TEST(Invariance, ADuplicatedFaceDoesNotDoubleTheFlux) {
    Scene scene = lit_cube();
    scene.polygons.push_back(scene.polygons[0]);
    const TransportRun run = run_transport(scene, {.directions = 1024});
    EXPECT_NEAR(run.mean_incoming(all_fronts) * 6.0 * 0.4, 1.0, 1e-3);
}

/// Root mean square deviation of the fronts from a long run.
double deviation(const TransportRun& run, const TransportRun& exact) {
    double sum = 0.0;
    for (std::uint32_t p = 0; p < run.patches.leaf_count; ++p)
        sum += std::pow(run.result.irradiance[p].x - exact.result.irradiance[p].x, 2);
    return std::sqrt(sum / run.patches.leaf_count);
}

// The average is begun anew at 8, 16, 32 and 64 directions: a run that ends soon after must not
// suffer.
TEST(Iterations, OneMoreDoesNoHarm) {
    const TransportRun exact = run_transport(lit_cube(), {.directions = 4096, .leaves = 200});
    for (const std::uint64_t m : {8, 16, 32, 64, 128}) {
        const double at =
            deviation(run_transport(lit_cube(), {.directions = m, .leaves = 200}), exact);
        const double after =
            deviation(run_transport(lit_cube(), {.directions = m + 1, .leaves = 200}), exact);
        // A single direction beyond a net weighs 2 / (m + 1) and may deviate by as much as the
        // mean.
        EXPECT_LT(after, 1.5 * at) << m;
    }
}

TEST(Invariance, StrayVerticesChangeNothing) {
    Scene scene = lit_cube();
    const TransportRun plain = run_transport(scene, {.directions = 64, .leaves = 200});
    scene.positions.emplace_back(1e4, 1e4, 1e4);
    // And those of a triangle without area.
    for (int i = 0; i < 3; ++i) {
        scene.corners.push_back(static_cast<std::uint32_t>(scene.positions.size()));
        scene.positions.emplace_back(-1e4, i == 2 ? 1.0 : 0.0, 0.0);
    }
    scene.corners.back() = scene.corners[scene.corners.size() - 2];
    scene.polygons.push_back({static_cast<std::uint32_t>(scene.corners.size() - 3), 3, 0, 0, 6});
    const TransportRun strayed = run_transport(scene, {.directions = 64, .leaves = 200});
    EXPECT_EQ(plain.result.coverage.size(), strayed.result.coverage.size());
    EXPECT_NEAR(plain.mean_incoming(all_fronts), strayed.mean_incoming(all_fronts), 1e-6);
}

// A ground far larger than the rest of the scene: its neighbours are met by too few fragments to be
// balanced.
TEST(Balance, StaysBoundedWhereFragmentsAreFew) {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, b.material(Spectrum(0.5f), Spectrum(1.0f)));
    b.polygon({{-1e5, -1e5, -1}, {1e5, -1e5, -1}, {1e5, 1e5, -1}, {-1e5, 1e5, -1}},
              b.material(Spectrum(0.5f)));
    const TransportRun run = run_transport(b.scene, {.directions = 128, .leaves = 100});
    double largest = 0.0;
    for (std::uint32_t p = 0; p < run.patches.leaf_count; ++p)
        largest = std::max<double>(largest, run.result.irradiance[p].x);
    EXPECT_LT(largest, 10.0 * std::numbers::pi) << "the balance blew up";
}

TEST(StandardError, CoversTheSpreadOfScrambledReplicates) {
    // It is meant to overstate, but by less than an order of magnitude; and never to promise too
    // much.
    constexpr int replicates = 8;
    std::vector<TransportRun> runs;
    for (int i = 0; i < replicates; ++i)
        runs.push_back(run_transport(
            lit_cube(),
            {.directions = 256, .leaves = 200, .seed = static_cast<std::uint64_t>(i + 1)}));
    double spread = 0.0, estimated = 0.0;
    for (std::uint32_t p = 0; p < runs[0].patches.leaf_count; ++p) {
        double mean = 0.0;
        for (const TransportRun& r : runs) mean += r.result.irradiance[p].x / replicates;
        for (const TransportRun& r : runs) {
            spread += std::pow(r.result.irradiance[p].x - mean, 2) / (replicates - 1);
            estimated += std::pow(r.result.standard_error[p].x, 2);
        }
    }
    EXPECT_GT(std::sqrt(estimated / spread), 1.0);
    EXPECT_LT(std::sqrt(estimated / spread), 10.0);
}

}  // namespace
