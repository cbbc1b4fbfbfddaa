#include "unit/render/dark_solution.h"
#include "unit/render/surface_builder.h"

#include <transillum/base/error.h>
#include <transillum/render/render_solution.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace transillum {
namespace {

using testing_support::SurfaceBuilder;
constexpr float pi = std::numbers::pi_v<float>;

Solution solution_of(const SurfaceMesh& surface, int level) {
    Solution s;
    s.surface = surface;
    s.patches = subdivide_to_levels(std::vector<int>(surface.triangles.size(), level));
    s.direct_irradiance.assign(s.patches.patch_count(), Spectrum(0.0f));
    s.indirect_irradiance = s.standard_error = s.direct_irradiance;
    s.coverage.assign(s.patches.patch_count(), 1.0f);
    return s;
}

constexpr std::array<glm::dvec3, 4> unit_square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};

SurfaceMesh white_square() {
    SurfaceBuilder builder;
    builder.quad(unit_square, builder.material(Spectrum(1.0f)), 0);
    return builder.build();
}

/// Looks at a point so closely that the image shows that point alone.
Camera close_up(const glm::dvec3& point, const glm::dvec3& from) {
    Camera camera;
    camera.eye = from;
    camera.look_at = point;
    camera.up = {0.123, 0.456, 0.789};
    camera.vertical_fov = 1e-4;
    return camera;
}

Spectrum seen_at(const Solution& s, const glm::dvec3& point, const glm::dvec3& from,
                 RenderOptions options = {}) {
    Monitor silent;
    options.width = options.height = 1;
    options.samples = 1;
    return render_solution(s, close_up(point, from), options, Workers(1), silent).at(0, 0);
}

glm::dvec3 leaf_centre(const Solution& s, std::uint32_t leaf) {
    glm::dvec3 centre(0.0);
    for (const glm::dvec3& corner : points_of_leaf(s.surface, s.patches, leaf))
        centre += corner / 3.0;
    return centre;
}

/// A square lamp of radiance 1 at z = 1, facing down, as n * n samples.
void add_lamp_samples(Solution& s, int n) {
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            s.direct.samples.push_back(
                {{-1.0 + (2.0 * i + 1.0) / n, -1.0 + (2.0 * j + 1.0) / n, 1.0},
                 {0, 0, -1},
                 4.0 / (n * n),
                 Spectrum(1.0f),
                 0,
                 false});
    testing_support::leave_samples_in_doubt(s);
}

/// The lamp itself, and a white floor on both sides of z = 0.
SurfaceMesh floor_under_lamp() {
    SurfaceBuilder builder;
    builder.quad({{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}},
                 builder.material(Spectrum(0.0f), Spectrum(1.0f)), 0);
    builder.quad({{{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}},
                 builder.material(Spectrum(1.0f)), 1);
    return builder.build();
}

TEST(RenderSolution, FlatShadingShowsThePatchsRadiance) {
    Solution s = solution_of(white_square(), 2);
    for (std::uint32_t patch = 0; patch < s.patches.patch_count(); ++patch) {
        s.indirect_irradiance[patch] = Spectrum(1.0f + static_cast<float>(patch), 2.0f, 0.0f);
        s.direct_irradiance[patch] = Spectrum(0.0f, 0.0f, 5.0f * static_cast<float>(patch));
    }
    RenderOptions flat;
    flat.interpolate = false;
    flat.direct = DirectShading::stored;
    for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf)
        for (const bool back : {false, true}) {
            const std::uint32_t patch = back ? s.patches.leaf_count + leaf : leaf;
            const glm::dvec3 centre = leaf_centre(s, leaf);
            const Spectrum seen =
                seen_at(s, centre, centre + glm::dvec3(0.1, 0.2, back ? -1.0 : 1.0), flat);
            const Spectrum expected =
                (s.indirect_irradiance[patch] + s.direct_irradiance[patch]) / pi;
            for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(seen[c], expected[c]) << "patch " << patch;
        }
}

TEST(RenderSolution, InterpolationReproducesALinearField) {
    Solution s = solution_of(white_square(), 3);
    const auto field = [](const glm::dvec3& p) { return 2.0 + 3.0 * p.x - 1.5 * p.y; };
    for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf) {
        s.indirect_irradiance[leaf] = Spectrum(static_cast<float>(field(leaf_centre(s, leaf))));
        s.direct_irradiance[leaf] = 2.0f * s.indirect_irradiance[leaf];
    }
    RenderOptions stored;
    stored.direct = DirectShading::stored;
    for (double x = 0.01; x < 1.0; x += 0.07)
        for (double y = 0.02; y < 1.0; y += 0.09) {
            const double seen = seen_at(s, {x, y, 0}, {0.5, 0.5, 2}, stored).x;
            EXPECT_NEAR(seen * pi, 3.0 * field({x, y, 0}), 3e-5) << x << ", " << y;
        }
}

TEST(RenderSolution, InterpolationStopsAtMaterials) {
    SurfaceBuilder builder;
    const auto a = builder.material(Spectrum(1.0f)), b = builder.material(Spectrum(0.5f));
    builder.quad(unit_square, a, 0);
    builder.quad({{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}}, b, 1);
    Solution s = solution_of(builder.build(), 1);
    for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf)
        s.indirect_irradiance[leaf] = Spectrum(leaf < s.patches.leaf_count / 2 ? 1.0f : 3.0f);
    for (double x = 0.05; x < 2.0; x += 0.1)
        EXPECT_FLOAT_EQ(seen_at(s, {x, 0.4, 0}, {1, 0.5, 3}).x * pi, x < 1.0 ? 1.0f : 1.5f);
}

TEST(RenderSolution, ComponentsAddUp) {
    Solution s = solution_of(floor_under_lamp(), 1);
    s.indirect_irradiance.assign(s.patches.patch_count(), Spectrum(0.25f * pi));
    add_lamp_samples(s, 4);
    const glm::dvec3 point(0.3, 0.2, 0.0), from(2.5, 0.0, 0.9);
    const auto with = [&](Components c) {
        RenderOptions options;
        options.components = c;
        return seen_at(s, point, from, options).x;
    };
    EXPECT_EQ(with({true, false, false}), 0.0f);
    EXPECT_FLOAT_EQ(with({false, false, true}), 0.25f);
    EXPECT_GT(with({false, true, false}), 0.1f);
    EXPECT_FLOAT_EQ(with({true, true, true}), with({false, true, false}) + 0.25f);
    EXPECT_EQ(seen_at(s, {0, 0, 1}, {2, 0, 0.1}).x, 1.0f) << "the lamp";
    EXPECT_EQ(seen_at(s, {0, 0, 1}, {0, 0, 2}).x, 0.0f) << "its back";
}

TEST(RenderSolution, TracedDirectLightConvergesToThePolygonLuminaire) {
    const double exact = 1.740840;
    std::array<double, 3> errors{};
    for (int i = 0; i < 3; ++i) {
        Solution s = solution_of(floor_under_lamp(), 0);
        add_lamp_samples(s, 8 << i);
        errors[i] = std::abs(seen_at(s, {0, 0, 0}, {2.5, 0, 0.5}).x * pi - exact);
    }
    // The midpoint rule is of second order.
    EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.5);
    EXPECT_NEAR(errors[1] / errors[2], 4.0, 0.5);
    EXPECT_LT(errors[2], 1e-3 * exact);
}

TEST(RenderSolution, LightReachesOnlyTheSideItFaces) {
    Solution s = solution_of(floor_under_lamp(), 0);
    add_lamp_samples(s, 2);
    EXPECT_GT(seen_at(s, {0, 0, 0}, {2.5, 0, 0.5}).x, 0.0f);
    EXPECT_EQ(seen_at(s, {0, 0, 0}, {2.5, 0, -0.5}).x, 0.0f) << "under the floor";
    for (LightSample& light : s.direct.samples) light.normal = {0, 0, 1};
    EXPECT_EQ(seen_at(s, {0, 0, 0}, {2.5, 0, 0.5}).x, 0.0f) << "the lamp turned away";
}

TEST(RenderSolution, TracedShadowsAreSharpWhateverThePatches) {
    SurfaceBuilder builder;
    const auto white = builder.material(Spectrum(1.0f));
    builder.quad({{{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}}, white, 0);
    builder.quad({{{0, -3, 0.5}, {3, -3, 0.5}, {3, 3, 0.5}, {0, 3, 0.5}}}, white, 1);
    Solution s = solution_of(builder.build(), 0);
    s.direct.samples.push_back({{0, 0, 1}, {0, 0, -1}, 1.0, Spectrum(1.0f), 0, false});
    testing_support::leave_samples_in_doubt(s);
    EXPECT_GT(seen_at(s, {-0.01, 0, 0}, {-2, 0, 0.4}).x, 0.1f);
    EXPECT_EQ(seen_at(s, {0.01, 0, 0}, {-2, 0, 0.4}).x, 0.0f);
}

TEST(RenderSolution, OneSidedBacksAreBlack) {
    SurfaceBuilder builder;
    const auto white = builder.material(Spectrum(1.0f));
    builder.quad(unit_square, white, 0);
    builder[white].back_reflects = false;
    Solution s = solution_of(builder.build(), 1);
    s.indirect_irradiance.assign(s.patches.patch_count(), Spectrum(1.0f));
    EXPECT_FLOAT_EQ(seen_at(s, {0.3, 0.6, 0}, {0.5, 0.5, 1}).x, 1.0f / pi);
    EXPECT_EQ(seen_at(s, {0.3, 0.6, 0}, {0.5, 0.5, -1}).x, 0.0f);
}

TEST(RenderSolution, OutlinesAreAveragedOverThePixel) {
    SurfaceBuilder builder;
    // 0.3 to 0.83 of an image that shows [0, 1] x [0, 1].
    builder.quad({{{0.3, 0.3, 0}, {0.83, 0.3, 0}, {0.83, 0.83, 0}, {0.3, 0.83, 0}}},
                 builder.material(Spectrum(0.0f), Spectrum(1.0f)), 0);
    const Solution s = solution_of(builder.build(), 0);
    Camera camera;
    camera.eye = {0.5, 0.5, 1};
    camera.look_at = {0.5, 0.5, 0};
    camera.vertical_fov = 360.0 / std::numbers::pi * std::atan(0.5);
    Monitor silent;
    RenderOptions options;
    options.width = options.height = 16;
    options.samples = 64;
    const Image image = render_solution(s, camera, options, Workers(1), silent);
    double mean = 0.0;
    for (const Spectrum& pixel : image.pixels) mean += pixel.x / 256.0;
    // 64 samples of a net lie one in each of 64 columns and rows: 1/64 at most for each of four
    // sides' pixels.
    EXPECT_NEAR(mean, 0.53 * 0.53, 4 * 0.53 / 16 / 64);
    EXPECT_EQ(image.emitter_mask[8 * 16 + 8], 1.0f);
    EXPECT_EQ(image.emitter_mask[0], 0.0f);
    EXPECT_NEAR(image.emitter_mask[8 * 16 + 4], 0.2f, 1.01f / 64.0f);  // the edge at 4.8 pixels
}

TEST(RenderSolution, DoesNotDependOnTheNumberOfThreads) {
    Solution s = solution_of(floor_under_lamp(), 3);
    for (std::uint32_t i = 0; i < s.patches.patch_count(); ++i)
        s.indirect_irradiance[i] = Spectrum(static_cast<float>(i % 7));
    add_lamp_samples(s, 3);
    Camera camera = close_up({0, 0, 0.5}, {5, 3, 2});
    camera.vertical_fov = 50.0;
    RenderOptions options;
    options.width = 61;
    options.height = 43;
    Monitor silent;
    const Image one = render_solution(s, camera, options, Workers(1), silent);
    for (const int threads : {2, 8}) {
        const Image many = render_solution(s, camera, options, Workers(threads), silent);
        EXPECT_EQ(many.pixels, one.pixels) << threads << " threads";
        EXPECT_EQ(many.emitter_mask, one.emitter_mask);
    }
}

TEST(RenderSolution, RefusesSenselessOptions) {
    const Solution s = solution_of(white_square(), 0);
    Monitor silent;
    RenderOptions options;
    for (const int samples : {0, 4097}) {
        options.samples = samples;
        EXPECT_THROW(
            (void)render_solution(s, close_up({0, 0, 0}, {1, 1, 1}), options, Workers(1), silent),
            UsageError);
    }
    options = {};
    options.height = 0;
    EXPECT_THROW(
        (void)render_solution(s, close_up({0, 0, 0}, {1, 1, 1}), options, Workers(1), silent),
        UsageError);
}

TEST(ChooseCamera, ByNameOrTheFirst) {
    Solution s = solution_of(white_square(), 0);
    s.cameras.resize(2);
    s.cameras[0].name = "door";
    s.cameras[1].name = "window";
    EXPECT_EQ(choose_camera(s.cameras, s.surface, "").name, "door");
    EXPECT_EQ(choose_camera(s.cameras, s.surface, "window").name, "window");
    EXPECT_THAT([&] { (void)choose_camera(s.cameras, s.surface, "roof"); },
                testing::ThrowsMessage<UsageError>(testing::HasSubstr("'door', 'window'")));
}

TEST(ChooseCamera, FramesTheSurfaceWhereThereIsNone) {
    Solution s = solution_of(white_square(), 0);
    s.indirect_irradiance.assign(s.patches.patch_count(), Spectrum(1.0f));
    Monitor silent;
    RenderOptions options;
    options.width = options.height = 32;
    const Image image =
        render_solution(s, choose_camera(s.cameras, s.surface, ""), options, Workers(1), silent);
    EXPECT_GT(image.at(16, 16).x, 0.0f);
    for (int i = 0; i < 32; ++i)
        for (const Spectrum& border :
             {image.at(i, 0), image.at(i, 31), image.at(0, i), image.at(31, i)})
            EXPECT_EQ(border.x, 0.0f);
}

}  // namespace
}  // namespace transillum
