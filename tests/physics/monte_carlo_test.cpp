// The Monte-Carlo component in the transport (paper §2.1 and §3.1): what coarse elements leave out
// is carried, and where they leave nothing out, nothing changes.
#include "physics/transport_runs.h"

#include <transillum/scene/brdf.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

class Carried : public testing::TestWithParam<MonteCarlo> {};

INSTANTIATE_TEST_SUITE_P(Representations, Carried,
                         testing::Values(MonteCarlo::subpatch, MonteCarlo::wavefront),
                         [](const auto& i) {
                             return i.param == MonteCarlo::subpatch ? "Subpatch" : "Wavefront";
                         });

TEST_P(Carried, IsNothingWhereLightIsUniform) {
    const Scene scene = cube_scene(0.6f, 0.4f, 0.4f);
    const TransportRun run =
        run_transport(scene, {.directions = 256, .leaves = 200, .monte_carlo = GetParam()});
    EXPECT_EQ(run.result.carried, 256u - 128u);
    for (std::uint32_t p = 0; p < run.patches.leaf_count; ++p) {
        ASSERT_NEAR(run.result.irradiance[p].x, std::numbers::pi, 1e-4 * std::numbers::pi);
        // Squares of what is counted in steps of 2^-16 of the radiance.
        ASSERT_NEAR(run.result.spatial_error[p], 0.0, 1e-7);
        ASSERT_NEAR(run.result.directional_error[p], 0.0, 1e-7);
    }
}

TEST_P(Carried, KeepsTheGlossyFurnace) {
    SceneBuilder b;
    Material& m = b.scene.materials[0];
    m.diffuse = Spectrum(0.3f);
    m.specular = Spectrum(0.4f);
    m.lobe = Lobe::max_phong;
    m.shininess = 10.0f;
    b.box({0, 0, 0}, {1, 1.5, 0.7}, Facing::inwards);
    TransportRun run = prepare_transport(b.scene, {.leaves = 200});
    const GlossySides& glossy = run.sources.glossy;
    run.sources.directional_emission = [&](const GlossySide& side, const glm::vec3& out) {
        return Spectrum(1.0f) - directional_albedo(glossy.brdfs[side.brdf], out.z);
    };
    iterate_in(run, {.directions = 1024, .resolution = 150, .monte_carlo = GetParam()});
    // A lobe's residual is no zero along two single directions, only in the mean: noise is left.
    double sum = 0.0, norms = 0.0;
    for (std::uint32_t p = 0; p < run.patches.leaf_count; ++p) {
        ASSERT_NEAR(run.result.irradiance[p].x * std::numbers::inv_pi, 1.0, 0.1);
        sum += run.result.irradiance[p].x * std::numbers::inv_pi;
        norms += run.result.directional_error[p];
    }
    EXPECT_NEAR(sum / run.patches.leaf_count, 1.0, 0.01);
    EXPECT_GT(norms, 0.0);
}

/// A floor, and low above it two plates that face it: one shines, the other is lit by what the
/// floor reflects. Nothing else.
class Plates : public testing::Test {
protected:
    static constexpr double height = 0.15, width = 0.2, radiance = 1.0, albedo = 0.8;
    static constexpr glm::dvec2 shining{0.1, 0.05}, lit{0.7, 0.05};

    static Scene scene() {
        SceneBuilder b;
        const auto white = b.material(Spectrum(static_cast<float>(albedo)));
        const auto light = b.material(Spectrum(0.0f), Spectrum(static_cast<float>(radiance)));
        const auto black = b.material(Spectrum(0.0f));
        b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, white);
        for (const auto& [corner, material] : {std::pair{shining, light}, std::pair{lit, black}}) {
            const glm::dvec3 o(corner, height);
            b.polygon({o, o + glm::dvec3(0, width, 0), o + glm::dvec3(width, width, 0),
                       o + glm::dvec3(width, 0, 0)},
                      material);
        }
        return b.scene;
    }

    /// Irradiance over pi of the unlit plate, by quadrature of both form factors.
    static double expected() {
        constexpr int n = 60, k = 8;
        const auto share = [](const glm::dvec2& floor, const glm::dvec2& plate) {
            const glm::dvec2 d = floor - plate;
            const double r2 = glm::dot(d, d) + height * height;
            return height * height / (r2 * r2);
        };
        const auto point = [](const glm::dvec2& corner, int i) {
            return corner + (glm::dvec2(i % k, i / k) + 0.5) * (width / k);
        };
        constexpr double piece = width * width / (k * k), floor_piece = 1.0 / (n * n);
        double sum = 0.0;
        for (int i = 0; i < n * n; ++i) {
            const glm::dvec2 x = (glm::dvec2(i % n, i / n) + 0.5) / double{n};
            double from_light = 0.0, to_plate = 0.0;
            for (int j = 0; j < k * k; ++j) {
                from_light += radiance * piece * share(x, point(shining, j));
                to_plate += share(x, point(lit, j)) / (k * k);
            }
            sum += floor_piece * from_light * to_plate;
        }
        return albedo * std::numbers::inv_pi * sum * std::numbers::inv_pi;
    }

    static double error_of(MonteCarlo monte_carlo, std::uint64_t seed = 1) {
        const SurfaceMesh mesh = build_surface_of(scene());
        // The plates are one element a triangle, the floor is as coarse.
        const PatchHierarchy patches =
            subdivide_to_levels(std::vector<int>(mesh.triangles.size(), 0));
        const TransportRun run = run_transport(
            mesh, patches,
            {.directions = 2048, .resolution = 160, .seed = seed, .monte_carlo = monte_carlo});
        const double mean = run.mean_incoming([&](std::uint32_t root, bool back) {
            return !back && mesh.triangles[root].source_face == 2;
        });
        return mean / expected() - 1.0;
    }

    static SurfaceMesh build_surface_of(const Scene& scene) {
        Monitor silent;
        return build_surface(scene, {}, silent);
    }
};

// The floor is one element a triangle, and shines all over where only a corner is lit. Its quarters
// know better, and the wavefront knows.
TEST_F(Plates, CoarseElementsAreCorrected) {
    const double by_elements = error_of(MonteCarlo::off);
    const double by_quarters = error_of(MonteCarlo::subpatch);
    // Few bundles meet both plates: of one seed, noise is all that is left.
    constexpr int seeds = 4;
    double by_wavefront = 0.0, square = 0.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const double error = error_of(MonteCarlo::wavefront, seed);
        by_wavefront += error / seeds;
        square += error * error / seeds;
    }
    const double standard_error = std::sqrt((square - by_wavefront * by_wavefront) / (seeds - 1.0));
    EXPECT_GT(by_elements, 3.0);
    EXPECT_LT(by_quarters, 0.5 * by_elements);
    EXPECT_LT(standard_error, 0.1);
    EXPECT_LT(std::abs(by_wavefront), 3.0 * standard_error);
}

TEST_P(Carried, DoesNotDependOnTheThreads) {
    RunOptions options{.directions = 160,
                       .leaves = 400,
                       .resolution = 150,
                       .threads = 1,
                       .monte_carlo = GetParam()};
    const Scene scene = two_rooms_scene(0.8f);
    const TransportRun one = run_transport(scene, options);
    for (const int threads : {2, 8}) {
        options.threads = threads;
        const TransportRun many = run_transport(scene, options);
        EXPECT_EQ(one.result.irradiance, many.result.irradiance) << threads << " threads";
        EXPECT_EQ(one.result.spatial_error, many.result.spatial_error) << threads << " threads";
    }
}

TEST_P(Carried, TwiceTheEmissionIsTwiceTheLightToTheLastBit) {
    const RunOptions options{
        .directions = 160, .leaves = 200, .resolution = 150, .monte_carlo = GetParam()};
    const TransportRun once = run_transport(cube_scene(0.6f, 1.0f, 0.0f), options);
    const TransportRun twice = run_transport(cube_scene(0.6f, 2.0f, 0.0f), options);
    for (std::uint32_t p = 0; p < once.patches.patch_count(); ++p)
        ASSERT_EQ(2.0f * once.result.irradiance[p], twice.result.irradiance[p]);
}

// Validation A3: the energy of a closed cube is known.
TEST_P(Carried, KeepsTheEnergyOfACube) {
    const TransportRun run = run_transport(
        cube_scene(0.8f, 1.0f, 0.0f),
        {.directions = 1024, .leaves = 400, .resolution = 150, .monte_carlo = GetParam()});
    EXPECT_NEAR(run.mean_incoming(all_fronts) * 6.0 * 0.2, 1.0, 5e-3);
}

// Some patches lie between pixels' centres: of what they received nothing is known, and nothing may
// be carried.
TEST_P(Carried, KeepsTheEnergyOfPatchesBetweenPixels) {
    const TransportRun run = run_transport(
        cube_scene(0.8f, 1.0f, 0.0f),
        {.directions = 1024, .leaves = 6000, .resolution = 60, .monte_carlo = GetParam()});
    EXPECT_NEAR(run.mean_incoming(all_fronts) * 6.0 * 0.2, 1.0, 0.01);
}

// Whatever number of directions a run begins with, the effect is measured before it is judged.
TEST(AutomaticMonteCarlo, IsMeasuredInLaterRunsToo) {
    const TransportRun run =
        prepare_transport(two_rooms_scene(0.8f), {.leaves = 0, .max_level = 0});
    Monitor silent;
    IterationOptions options;
    options.iterations = 512;
    options.pixel_size = pixel_size_for(run.surface, 150);
    options.keep_sums = true;
    const Workers workers(2);
    options.start = iterate(run.surface, run.patches, run.sources, options, workers, silent).sums;
    options.monte_carlo = MonteCarlo::automatic;
    options.iterations = 1024;
    const TransportResult later =
        iterate(run.surface, run.patches, run.sources, options, workers, silent);
    EXPECT_GT(later.residual_effect, 0.01);
    EXPECT_LT(later.relative_error, 1.0);
}

TEST(AutomaticMonteCarlo, IsCarriedOnlyWhereItIsWorthIt) {
    RunOptions options{
        .directions = 1024, .leaves = 400, .resolution = 150, .monte_carlo = MonteCarlo::automatic};
    const TransportRun uniform = run_transport(cube_scene(0.6f, 0.4f, 0.4f), options);
    EXPECT_EQ(uniform.result.carried, 128u);
    EXPECT_FALSE(uniform.result.carried_to_the_end);
    EXPECT_LT(uniform.result.residual_effect, 1e-6);
    options.leaves = 0;
    options.max_level = 0;
    options.directions = 1024;
    const TransportRun coarse = run_transport(two_rooms_scene(0.8f), options);
    EXPECT_TRUE(coarse.result.carried_to_the_end) << coarse.result.residual_effect;
    EXPECT_GT(coarse.result.residual_effect, 0.01);
}

// Plain stochastic iteration: all light goes from bundle to bundle. Validation A1, and A3, which it
// nears more slowly: its error is all noise.
TEST_P(Carried, AloneIsPlainIteration) {
    const RunOptions plain{.directions = 4096,
                           .leaves = 100,
                           .resolution = 100,
                           .averaging = Averaging::none,
                           .monte_carlo = GetParam()};
    const TransportRun cube = run_transport(cube_scene(0.5f, 1.0f, 0.0f), plain);
    EXPECT_EQ(cube.result.carried, 4096u);
    EXPECT_NEAR(cube.mean_incoming(all_fronts) * 6.0 * 0.5, 1.0, 0.05);
}

TEST(MonteCarloMemory, FollowsWhatIsKept) {
    const TransportRun room = prepare_transport(cube_scene(0.5f, 1.0f, 0.0f), {.leaves = 400});
    const auto bytes = [&](MonteCarlo monte_carlo, double pixel_size, int threads) {
        return monte_carlo_bytes(monte_carlo, room.surface, room.patches, pixel_size, threads);
    };
    EXPECT_EQ(bytes(MonteCarlo::off, 0.01, 2), 0u);
    EXPECT_EQ(bytes(MonteCarlo::subpatch, 0.01, 2), bytes(MonteCarlo::subpatch, 0.001, 2));
    EXPECT_EQ(bytes(MonteCarlo::automatic, 0.01, 2), bytes(MonteCarlo::subpatch, 0.01, 2));
    EXPECT_GT(bytes(MonteCarlo::subpatch, 0.01, 4), bytes(MonteCarlo::subpatch, 0.01, 2));
    // The cube's 6 squares under half their area, 32 bytes a point, twice and half as much again.
    const double finer = static_cast<double>(bytes(MonteCarlo::wavefront, 0.001, 2)) -
                         static_cast<double>(bytes(MonteCarlo::wavefront, 0.01, 2));
    EXPECT_NEAR(finer, 96.0 * 3.0 * (1e6 - 1e4), 100.0);
}

TEST(MonteCarloOff, LeavesNoNorms) {
    const TransportRun run = run_transport(cube_scene(0.6f, 1.0f, 0.0f), {});
    EXPECT_EQ(run.result.carried, 0u);
    EXPECT_TRUE(run.result.spatial_error.empty());
    EXPECT_TRUE(run.result.directional_error.empty());
}

}  // namespace
