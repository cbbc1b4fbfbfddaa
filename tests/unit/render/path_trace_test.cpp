#include "unit/render/surface_builder.h"

#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/render/path_trace.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace transillum {
namespace {

using testing_support::SurfaceBuilder;

/// Mean of independent estimates and its standard error.
struct Estimate {
    double sum = 0.0, sum_squares = 0.0;
    int count = 0;
    void add(double x) {
        sum += x;
        sum_squares += x * x;
        ++count;
    }
    [[nodiscard]] double mean() const { return sum / count; }
    [[nodiscard]] double error() const {
        return std::sqrt(std::max(0.0, sum_squares / count - mean() * mean()) / (count - 1));
    }
};

/// Within five standard errors, which are themselves small enough for the comparison to mean
/// something.
void expect_estimates(const Estimate& e, double exact, double relative_error) {
    EXPECT_LT(e.error(), relative_error * exact);
    EXPECT_NEAR(e.mean(), exact, 5.0 * e.error() + 1e-6 * exact);
}

SurfaceMesh unit_room(float albedo, const std::array<float, 6>& emission) {
    SurfaceBuilder builder;
    std::array<std::uint32_t, 6> materials{};
    for (int i = 0; i < 6; ++i)
        materials[i] = builder.material(Spectrum(albedo), Spectrum(emission[i]));
    builder.room({0, 0, 0}, {1, 1, 1}, materials);
    return builder.build();
}

Camera camera_in_room() {
    Camera camera;
    camera.eye = {0.3, 0.4, 0.6};
    camera.look_at = {0.9, 0.8, 0.1};
    camera.up = {0, 0, 1};
    camera.vertical_fov = 100.0;
    return camera;
}

/// Mean irradiance over a rectangle, from independently scrambled replicates.
Estimate mean_irradiance(const SurfaceMesh& mesh, const glm::dvec3& origin, const glm::dvec3& u,
                         const glm::dvec3& v, const glm::dvec3& normal) {
    Estimate e;
    for (std::uint64_t replicate = 0; replicate < 16; ++replicate) {
        double sum = 0.0;
        for (std::uint32_t i = 0; i < 64; ++i) {
            const glm::dvec3 point =
                origin + sobol_owen(i, 0, replicate) * u + sobol_owen(i, 1, replicate) * v;
            sum += path_trace_irradiance(mesh, {}, point, normal, 16, 64 * replicate + i).x;
        }
        e.add(sum / 64);
    }
    return e;
}

class Furnace : public ::testing::TestWithParam<float> {};

TEST_P(Furnace, EveryPixelSeesTheClosedForm) {
    const float albedo = GetParam();
    const SurfaceMesh room = unit_room(albedo, {1, 1, 1, 1, 1, 1});
    Monitor silent;
    Estimate e;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const Image image =
            path_trace(room, {}, camera_in_room(), {24, 16, 16, 0, seed}, Workers(1), silent);
        double sum = 0.0;
        for (const Spectrum& pixel : image.pixels) sum += pixel.y;
        e.add(sum / static_cast<double>(image.pixels.size()));
    }
    expect_estimates(e, 1.0 / (1.0 - albedo), 0.003);
}

INSTANTIATE_TEST_SUITE_P(Albedos, Furnace, ::testing::Values(0.5f, 0.9f));

TEST(PathTrace, MeanIrradianceInAClosedRoomFollowsFromItsFlux) {
    // Flux pi over 6 * (1 - 0.8), whatever emits.
    const SurfaceMesh room = unit_room(0.8f, {1, 0, 0, 0, 0, 0});
    double mean = 0.0, variance = 0.0;
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2, side = face % 2;
        glm::dvec3 origin(0.0), u(0.0), v(0.0), normal(0.0);
        origin[axis] = side;
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1.0;
        normal[axis] = side ? -1.0 : 1.0;
        const Estimate e = mean_irradiance(room, origin, u, v, normal);
        mean += e.mean() / 6.0;
        variance += e.error() * e.error() / 36.0;
    }
    const double exact = std::numbers::pi / (6.0 * 0.2);
    EXPECT_LT(std::sqrt(variance), 0.005 * exact);
    EXPECT_NEAR(mean, exact, 5.0 * std::sqrt(variance));
}

struct Squares {
    const char* name;
    std::array<glm::dvec3, 4> emitter;
    double form_factor;
};

class FormFactor : public ::testing::TestWithParam<Squares> {};

TEST_P(FormFactor, OfTwoUnitSquares) {
    SurfaceBuilder builder;
    const auto black = builder.material(Spectrum(0.0f)),
               lamp = builder.material(Spectrum(0.0f), Spectrum(1.0f));
    builder.quad({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, black, 0);
    builder.quad(GetParam().emitter, lamp, 1);
    const Estimate e = mean_irradiance(builder.build(), {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    expect_estimates(e, std::numbers::pi * GetParam().form_factor, 0.005);
}

std::array<glm::dvec3, 4> square_above(double z) {
    return {{{0, 0, z}, {0, 1, z}, {1, 1, z}, {1, 0, z}}};
}

INSTANTIATE_TEST_SUITE_P(Pairs, FormFactor,
                         ::testing::Values(Squares{"distance1", square_above(1.0), 0.1998249},
                                           Squares{"distance05", square_above(0.5), 0.4152533},
                                           Squares{"distance4", square_above(4.0), 0.0191070},
                                           Squares{"perpendicular",
                                                   {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}},
                                                   0.2000438}),
                         [](const auto& info) { return info.param.name; });

TEST(PathTrace, PointToPolygonLuminaire) {
    SurfaceBuilder builder;
    builder.quad({{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}},
                 builder.material(Spectrum(0.0f), Spectrum(1.0f, 2.0f, 0.0f)), 0);
    const SurfaceMesh mesh = builder.build();
    Estimate e;
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        const Spectrum E = path_trace_irradiance(mesh, {}, {0, 0, 0}, {0, 0, 1}, 1024, seed);
        e.add(E.x);
        EXPECT_FLOAT_EQ(E.y, 2.0f * E.x);
        EXPECT_EQ(E.z, 0.0f);
    }
    expect_estimates(e, 1.740840, 0.001);
    EXPECT_EQ(path_trace_irradiance(mesh, {}, {0, 0, 2}, {0, 0, -1}, 64, 1), Spectrum(0.0f))
        << "dark back";
}

TEST(PathTrace, SidesFollowTheMaterial) {
    SurfaceBuilder builder;
    const auto lamp = builder.material(Spectrum(0.0f), Spectrum(1.0f));
    builder.quad({{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}}, lamp, 0);
    builder[lamp].back_emits = true;
    const SurfaceMesh both = builder.build();
    EXPECT_GT(path_trace_irradiance(both, {}, {0, 0, 2}, {0, 0, -1}, 64, 1).x, 1.0f);

    // The lamp faces the back of the floor.
    SurfaceBuilder room;
    const auto white = room.material(Spectrum(0.9f)),
               bulb = room.material(Spectrum(0.0f), Spectrum(1.0f));
    room.quad({{{-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0}}}, white, 0);
    room.quad({{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}}, bulb, 1);
    Camera camera;
    camera.eye = {0, 0, 0.5};
    camera.look_at = {0, 0, 0};
    camera.up = {0, 1, 0};
    Monitor silent;
    const Image grey = path_trace(room.build(), {}, camera, {4, 4, 4, 0, 1}, Workers(1), silent);
    EXPECT_GT(grey.at(1, 1).x, 0.1f);
    room[white].back_reflects = false;
    const Image black = path_trace(room.build(), {}, camera, {4, 4, 4, 0, 1}, Workers(1), silent);
    for (const Spectrum& pixel : black.pixels) EXPECT_EQ(pixel, Spectrum(0.0f));
}

TEST(PathTrace, WithoutEmittersEverythingIsBlack) {
    Monitor silent;
    const Image image =
        path_trace(unit_room(0.9f, {}), {}, camera_in_room(), {8, 8, 4, 0, 1}, Workers(2), silent);
    ASSERT_EQ(image.pixels.size(), 64u);
    for (const Spectrum& pixel : image.pixels) EXPECT_EQ(pixel, Spectrum(0.0f));
}

TEST(PathTrace, MarksEmitters) {
    Monitor silent;
    const Image image = path_trace(unit_room(0.5f, {1, 0, 0, 0, 0, 0}), {}, camera_in_room(),
                                   {32, 32, 4, 1, 1}, Workers(1), silent);
    int marked = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        // One emitted unit in each sample that sees it; a wall reflects at most half of that.
        EXPECT_GE(image.pixels[i].x, image.emitter_mask[i]);
        marked += image.emitter_mask[i] == 1.0f;
        if (image.emitter_mask[i] == 0.0f) {
            EXPECT_LT(image.pixels[i].x, 1.0f);
        }
    }
    EXPECT_GT(marked, 10);
    EXPECT_LT(marked, 900);
}

TEST(PathTrace, BouncesAreBounded) {
    // In a furnace n reflections give the geometric series' first n + 1 terms.
    const SurfaceMesh room = unit_room(0.5f, {1, 1, 1, 1, 1, 1});
    Monitor silent;
    for (int i = 0; i < 6; ++i) {
        const int bounces = 1 + i / 2;
        const bool shares = i % 2 == 0;
        Estimate e;
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const Image image = path_trace(room, {}, camera_in_room(),
                                           {12, 12, 32, bounces, seed, shares}, Workers(1), silent);
            double sum = 0.0;
            for (const Spectrum& pixel : image.pixels) sum += pixel.x;
            e.add(sum / 144.0);
        }
        expect_estimates(e, 2.0 - std::exp2(-bounces), 0.003);
    }
}

TEST(PathTrace, DoesNotDependOnTheNumberOfThreads) {
    const SurfaceMesh room = unit_room(0.7f, {0, 1, 0, 0, 0, 0});
    Monitor silent;
    const PathTraceOptions options{37, 23, 6, 0, 9};
    const Image one = path_trace(room, {}, camera_in_room(), options, Workers(1), silent);
    for (const int threads : {2, 8}) {
        const Image many =
            path_trace(room, {}, camera_in_room(), options, Workers(threads), silent);
        EXPECT_EQ(many.pixels, one.pixels) << threads << " threads";
        EXPECT_EQ(many.emitter_mask, one.emitter_mask);
    }
}

TEST(PathTrace, RefusesSenselessOptions) {
    const SurfaceMesh room = unit_room(0.5f, {});
    Monitor silent;
    const Workers workers(1);
    EXPECT_THROW((void)path_trace(room, {}, camera_in_room(), {8, 8, 0, 0, 1}, workers, silent),
                 UsageError);
    EXPECT_THROW((void)path_trace(room, {}, camera_in_room(), {8, 8, 1, -1, 1}, workers, silent),
                 UsageError);
    EXPECT_THROW((void)path_trace(room, {}, camera_in_room(), {0, 8, 1, 0, 1}, workers, silent),
                 UsageError);
    Camera camera = camera_in_room();
    camera.vertical_fov = 180.0;
    EXPECT_THROW((void)path_trace(room, {}, camera, {8, 8, 1, 0, 1}, workers, silent), UsageError);
    camera = camera_in_room();
    camera.up = camera.look_at - camera.eye;
    EXPECT_THROW((void)path_trace(room, {}, camera, {8, 8, 1, 0, 1}, workers, silent), UsageError);
    camera = camera_in_room();
    camera.look_at = camera.eye;
    EXPECT_THROW((void)path_trace(room, {}, camera, {8, 8, 1, 0, 1}, workers, silent), UsageError);
}

}  // namespace
}  // namespace transillum
