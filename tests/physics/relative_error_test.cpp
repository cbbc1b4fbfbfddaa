// The error that an iteration tells of itself, against the error there is.
#include "physics/transport_runs.h"

#include <transillum/visibility/transillumination_buffer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

using Values = std::vector<double>;

TransportResult iterate_to(const TransportRun& run, std::uint64_t directions, std::uint64_t seed,
                           double target = 0.0) {
    Monitor silent;
    IterationOptions options;
    options.iterations = directions;
    options.pixel_size = pixel_size_for(run.surface, 200);
    options.seed = seed;
    options.target_error = target;
    return iterate(run.surface, run.patches, run.sources, options, Workers(2), silent);
}

Values values_of(const TransportResult& result) {
    Values values;
    for (const Spectrum& e : result.irradiance) values.push_back(luminance(SpectrumSum(e)));
    return values;
}

/// Root mean square over the patches that reflect, over the mean of `truth` there.
double relative_difference(const TransportRun& run, const Values& a, const Values& truth) {
    double area = 0.0, mean = 0.0, square = 0.0;
    for (std::uint32_t p = 0; p < a.size(); ++p) {
        if (run.sources.albedo[p].x == 0.0f) continue;
        const double w = area_of_leaf(run.surface, run.patches, run.patches.leaf_of_patch(p));
        area += w;
        mean += w * truth[p];
        square += w * (a[p] - truth[p]) * (a[p] - truth[p]);
    }
    return std::sqrt(square * area) / mean;
}

struct ErrorCase {
    const char* name;
    Scene scene;
};
std::vector<ErrorCase> error_cases() {
    return {{"cube", cube_scene(0.5f, 1.0f, 0.0f)},
            {"bright cube", cube_scene(0.9f, 1.0f, 0.0f)},
            {"two rooms", two_rooms_scene(0.8f)}};
}

// The root mean square of 12 runs' errors is known to some 1 / sqrt(2 * 12) = 20 % and better, as
// every run has many patches; the estimate is to be within a factor of 1.5.
TEST(RelativeError, IsTheErrorThereIs) {
    for (const ErrorCase& c : error_cases()) {
        const TransportRun run = prepare_transport(c.scene, {.leaves = 500});
        const Values truth = values_of(iterate_to(run, 8192, 99));
        for (const std::uint64_t directions : {128, 320, 512}) {
            double told = 0.0, square = 0.0;
            for (std::uint64_t seed = 1; seed <= 12; ++seed) {
                const TransportResult result = iterate_to(run, directions, seed);
                told += result.relative_error * result.relative_error;
                square += std::pow(relative_difference(run, values_of(result), truth), 2.0);
            }
            const double ratio = std::sqrt(told / square);
            EXPECT_GT(ratio, 1.0 / 1.5) << c.name << ", " << directions;
            EXPECT_LT(ratio, 1.5) << c.name << ", " << directions;
        }
    }
}

TEST(TargetError, IsMetWhereARunStops) {
    constexpr double target = 0.03;
    for (const ErrorCase& c : error_cases()) {
        const TransportRun run = prepare_transport(c.scene, {.leaves = 500});
        const Values truth = values_of(iterate_to(run, 8192, 99));
        int within = 0;
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const TransportResult result = iterate_to(run, 4096, seed, target);
            EXPECT_LT(result.iterations, 4096u) << c.name;
            within += relative_difference(run, values_of(result), truth) <= target ? 1 : 0;
        }
        EXPECT_GE(within, 9) << c.name;
    }
}

/// Notes the error told after every direction.
class ErrorsTold : public Monitor {
public:
    void progress(const Progress& p) override { told[p.done] = p.error; }
    std::map<std::uint64_t, double> told;
};

// In the octave after a restart as elsewhere: up to the next block's end, a run tells the error
// that it would have if it had stopped at the last one's.
TEST(RelativeError, IsToldOfARunThatEndsThere) {
    const TransportRun run = prepare_transport(cube_scene(0.5f, 1.0f, 0.0f), {.leaves = 500});
    ErrorsTold errors;
    IterationOptions options;
    options.iterations = 256;
    options.pixel_size = pixel_size_for(run.surface, 200);
    options.seed = 1;
    (void)iterate(run.surface, run.patches, run.sources, options, Workers(2), errors);
    for (const std::uint64_t directions : {64, 80, 96, 112, 128, 160}) {
        const double there = iterate_to(run, directions, 1).relative_error;
        EXPECT_NEAR(errors.told.at(directions + 1), there, 0.03 * there) << directions;
    }
}

// Standard errors of patches make up the error of the whole.
TEST(StandardError, OfPatchesAgreesWithTheRelativeError) {
    const TransportRun run = prepare_transport(cube_scene(0.5f, 1.0f, 0.0f), {.leaves = 500});
    const TransportResult result = iterate_to(run, 512, 1);
    double variance = 0.0, mean = 0.0, area = 0.0;
    for (std::uint32_t p = 0; p < result.irradiance.size(); ++p) {
        if (result.coverage[p] == 0.0f) continue;
        const double w = area_of_leaf(run.surface, run.patches, run.patches.leaf_of_patch(p));
        area += w;
        mean += w * result.irradiance[p].x;
        variance += w * std::pow(double{result.standard_error[p].x}, 2.0);
    }
    EXPECT_NEAR(std::sqrt(variance * area) / mean, result.relative_error,
                1e-3 * result.relative_error);
}

// A sealed place is as bright as its own sources make it, even where these are next to nothing.
TEST(SealedPlace, TakesNothingFromItsCluster) {
    constexpr float albedo = 0.9f, leaked = 1e-5f;
    SceneBuilder b;
    b.box({-1, -1, -1}, {2, 2, 2}, Facing::inwards, b.material(Spectrum(0.5f), Spectrum(1.0f)));
    b.box({0, 0, 0}, {1, 1, 1}, Facing::outwards, b.material(Spectrum(albedo)));
    TransportRun run = prepare_transport(b.scene, {.leaves = 500});
    const auto is_inside = [&](std::uint32_t patch) {
        const std::uint32_t root = run.patches.root_of_leaf[run.patches.leaf_of_patch(patch)];
        return root >= 12 && run.patches.is_back(patch);
    };
    for (std::uint32_t p = 0; p < run.patches.patch_count(); ++p)
        if (is_inside(p)) run.sources.direct[p] = Spectrum(leaked);
    const TransportResult result = iterate_to(run, 64, 1);
    for (std::uint32_t p = 0; p < run.patches.patch_count(); ++p) {
        if (!is_inside(p)) continue;
        // Twice: its cluster's energy was out of balance at first.
        EXPECT_LT(result.irradiance[p].x / std::numbers::pi, 2.0f * leaked / (1.0f - albedo));
    }
}

}  // namespace
