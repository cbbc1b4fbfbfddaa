#include "support/closed_forms.h"
#include "support/random_hierarchy.h"
#include "support/scene_builder.h"

#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/visibility/hemicube.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <numbers>

namespace transillum {
namespace {

using namespace testing_support;
constexpr double pi = std::numbers::pi;

/// About n, turned by a random angle.
glm::dmat3 turned_frame(const glm::dvec3& n, Random& random) {
    const double turn = 2.0 * pi * random.next(), c = std::cos(turn), s = std::sin(turn);
    const glm::dmat3 f = frame_about(n);
    return {c * f[0] + s * f[1], c * f[1] - s * f[0], f[2]};
}

struct Model {
    SurfaceMesh mesh;
    PatchHierarchy patches;
    Model(const SceneBuilder& builder, int level)
        : mesh(builder.surface()),
          patches(subdivide_to_levels(std::vector<int>(mesh.triangles.size(), level))) {}

    /// Cosine-weighted solid angle of the patches of one polygon and side, seen or not.
    [[nodiscard]] double solid_angle(const std::vector<PatchView>& views, std::uint32_t polygon,
                                     bool back, bool seen) const {
        double sum = 0.0;
        for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
            const std::uint32_t root = patches.root_of_leaf[patches.leaf_of_patch(p)];
            if (mesh.triangles[root].source_face != polygon || patches.is_back(p) != back) continue;
            sum += area_of_leaf(mesh, patches, patches.leaf_of_patch(p)) * views[p].mean_kernel *
                   (seen ? views[p].visibility : 1.0f);
        }
        return sum;
    }
};

constexpr int turns = 24;

/// The same over random turns of the hemicube.
Estimate seen_from(const Model& model, const glm::dvec3& point, const glm::dvec3& n,
                   std::uint32_t polygon, int resolution, bool seen = true) {
    Hemicube hemicube(model.mesh, model.patches, resolution);
    Random random(12, 3);
    std::vector<double> values;
    for (int i = 0; i < turns; ++i)
        values.push_back(
            model.solid_angle(hemicube.look(point, turned_frame(n, random)), polygon, false, seen));
    return estimate(values);
}

/// The midpoint rule over pixels is off by about (edge)^2 / 12, relative, beside the outline's
/// noise.
double midpoint_error(int resolution) {
    return 4.0 / (12.0 * resolution * resolution);
}

void expect_near(const Estimate& e, double expected, int resolution) {
    EXPECT_NEAR(e.mean, expected, 4.0 * e.error + midpoint_error(resolution) * expected);
    EXPECT_LT(e.error, 2e-3 * expected);
}

TEST(Hemicube, SquareOverheadAgreesWithTheClosedForm) {
    // Seen from below, facing down: clockwise from above.
    SceneBuilder corner, centred;
    corner.polygon({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});
    centred.polygon({{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}});
    for (const int level : {0, 3}) {
        expect_near(seen_from(Model(corner, level), {0, 0, 0}, {0, 0, 1}, 0, 256), 0.1385316 * pi,
                    256);
        expect_near(seen_from(Model(centred, level), {0, 0, 0}, {0, 0, 1}, 0, 256), 1.740840, 256);
    }
    EXPECT_NEAR(polygon_irradiance(centred.scene.positions, {0, 0, 0}, {0, 0, 1}), 1.740840, 1e-6);
}

TEST(Hemicube, SlantedTriangleAgreesWithTheClosedForm) {
    SceneBuilder builder;
    builder.polygon({{-0.7, 0.2, 0.9}, {0.4, 1.1, 1.6}, {0.9, -0.4, 0.5}});
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.2, 0.1, 1.0));
    expect_near(seen_from(Model(builder, 2), {0, 0, 0}, n, 0, 256),
                polygon_irradiance(builder.scene.positions, {0, 0, 0}, n), 256);
}

TEST(Hemicube, AClosedBoxFillsTheHemisphere) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    const Model model(builder, 3);
    Hemicube hemicube(model.mesh, model.patches, 512);  // dozens of pixels a patch
    Random random(3, 1);
    for (int i = 0; i < 12; ++i) {
        const glm::dvec3 n = uniform_direction((i + 0.5) / 12.0, random.next());
        const glm::dvec3 point(0.1 + 0.8 * random.next(), 0.1 + 0.8 * random.next(),
                               0.1 + 0.8 * random.next());
        const auto& views = hemicube.look(point, turned_frame(n, random));
        double front = 0.0, back = 0.0;
        for (std::uint32_t f = 0; f < 6; ++f) {
            front += model.solid_angle(views, f, false, true);
            back += model.solid_angle(views, f, true, true);
        }
        // Pixels' weights are at the midpoints; a seam may lose a pixel in a hundred thousand.
        EXPECT_NEAR(front, pi, 1e-4 * pi);
        EXPECT_EQ(back, 0.0);
    }
}

TEST(Hemicube, AScreenHidesHalf) {
    SceneBuilder builder;
    builder.polygon({{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}});
    builder.polygon({{0, -2, 0.5}, {0, 2, 0.5}, {2, 2, 0.5}, {2, -2, 0.5}});
    const Model model(builder, 4);
    expect_near(seen_from(model, {0, 0, 0}, {0, 0, 1}, 0, 256), 1.740840 / 2.0, 256);
    // As if unoccluded, it is whole: flux is kept for what is seen, which scales the rest alike.
    const Estimate whole = seen_from(model, {0, 0, 0}, {0, 0, 1}, 0, 256, false);
    EXPECT_NEAR(whole.mean, 1.740840, 0.005 * 1.740840);
}

/// A floor half below the horizon of a lamp that shines sideways.
TEST(Hemicube, ALeafAcrossTheHorizonCountsWhatIsAbove) {
    SceneBuilder builder;
    builder.polygon({{-2, -1, -1}, {1, -1, -1}, {0.5, 1, -1}});
    const Model model(builder, 0);
    const glm::dvec3 n(1, 0, 0);
    // Clipped at x = 0 by hand: on the lower edge and on the one from (0.5, 1) to (-2, -1).
    const double expected =
        polygon_irradiance({{0, -1, -1}, {1, -1, -1}, {0.5, 1, -1}, {0, 0.6, -1}}, {0, 0, 0}, n);
    expect_near(seen_from(model, {0, 0, 0}, n, 0, 256), expected, 256);
    // Flux is kept by a common factor: beside a wall wholly above, it cannot make up for a wrong
    // share.
    builder.polygon({{2, -1, 0}, {2, -1, 1}, {2, 1, 1}, {2, 1, 0}});
    EXPECT_NEAR(seen_from(Model(builder, 0), {0, 0, 0}, n, 0, 256).mean, expected, 0.03 * expected);
    // The mean is over the whole leaf, of which the part below adds nothing.
    Hemicube hemicube(model.mesh, model.patches, 256);
    Random random(2, 2);
    std::vector<double> kernels;
    for (int i = 0; i < turns; ++i)
        kernels.push_back(hemicube.look({0, 0, 0}, turned_frame(n, random))[0].mean_kernel);
    expect_near(estimate(kernels), expected / area_of(model.mesh, 0), 256);
}

TEST(Hemicube, OwnPlaneAndWhatLiesBehindSeeNothing) {
    SceneBuilder builder;
    builder.polygon(
        {{-1, -1, 0.3}, {1, -1, 0.3}, {1, 1, 0.3}, {-1, 1, 0.3}});          // the point's own plane
    builder.polygon({{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}});  // behind
    builder.polygon({{-1, -1, 1.3}, {-1, 1, 1.3}, {1, 1, 1.3}, {1, -1, 1.3}});  // overhead
    const Model model(builder, 2);
    Hemicube hemicube(model.mesh, model.patches, 64);
    Random random(4, 9);
    for (int i = 0; i < turns; ++i) {
        const auto& views = hemicube.look({0.1, -0.2, 0.3}, turned_frame({0, 0, 1}, random));
        for (const bool back : {false, true})
            for (const bool seen : {false, true}) {
                EXPECT_EQ(model.solid_angle(views, 0, back, seen), 0.0);
                EXPECT_EQ(model.solid_angle(views, 1, back, seen), 0.0);
            }
        EXPECT_GT(model.solid_angle(views, 2, false, true), 1.0);
        EXPECT_EQ(model.solid_angle(views, 2, true, true), 0.0);
    }
}

/// The same on planes in which rounding leaves a point a little above or below: the further from
/// the origin, the more of the triangle's size that is.
TEST(Hemicube, APointOnASlantedPlaneDoesNotSeeIt) {
    Random random(7, 7);
    for (const double away : {0.0, 3.0, 1e3, 1e6})
        for (int i = 0; i < 50; ++i) {
            const double u = random.next();
            const glm::dmat3 f = frame_about(uniform_direction(u, random.next()));
            const double w = random.next();
            const glm::dvec3 o = away * uniform_direction(w, random.next());
            SceneBuilder builder;
            builder.polygon({o + f[0], o - 0.5 * f[0] + 0.8 * f[1], o - 0.5 * f[0] - 0.8 * f[1]});
            builder.polygon(
                {o + 10.0 * f[2], o + 10.0 * f[2] + 4.0 * f[1], o + 10.0 * f[2] + 4.0 * f[0]});
            const Model model(builder, 1);
            Hemicube hemicube(model.mesh, model.patches, 64);
            const auto& v = model.mesh.triangles[0].vertices;
            const double b1 = 0.9 * random.next(), b2 = (0.95 - b1) * random.next();
            const glm::dvec3 point = (1.0 - b1 - b2) * model.mesh.positions[v[0]] +
                                     b1 * model.mesh.positions[v[1]] +
                                     b2 * model.mesh.positions[v[2]];
            const auto& views =
                hemicube.look(point, turned_frame(normal_of(model.mesh, 0), random));
            for (const bool back : {false, true})
                EXPECT_EQ(model.solid_angle(views, 0, back, true), 0.0) << "away " << away;
            EXPECT_GT(
                model.solid_angle(views, 1, false, true) + model.solid_angle(views, 1, true, true),
                0.0);
        }
}

TEST(Hemicube, PatchesBetweenPixelsGetTheirKernel) {
    SceneBuilder builder;
    builder.polygon({{-4, -4, 4}, {-4, 4, 4}, {4, 4, 4}, {4, -4, 4}});
    const double size = 1e-4;
    const glm::dvec3 at(0.2, 0.1, 1.0);
    builder.polygon({at, at + glm::dvec3(0, size, 0), at + glm::dvec3(size, 0, 0)});
    const glm::dvec3 hidden(0.6, 0.5, 5.0);
    builder.polygon({hidden, hidden + glm::dvec3(0, size, 0), hidden + glm::dvec3(size, 0, 0)});
    Model model(builder, 0);
    model.patches = subdivide_to_levels({4, 4, 0, 0});
    const std::uint32_t shown = 2 * 256, behind = shown + 1;
    Hemicube hemicube(model.mesh, model.patches, 64);
    Random random(3, 8);
    for (int i = 0; i < turns; ++i) {
        const auto& views = hemicube.look({0, 0, 0}, turned_frame({0, 0, 1}, random));
        const auto kernel = [](const glm::dvec3& p) {
            return p.z * p.z / (glm::dot(p, p) * glm::dot(p, p));
        };
        // Flux is kept by a common factor, here of a ceiling at 64 pixels: within a percent.
        EXPECT_NEAR(views[shown].mean_kernel / kernel(at), 1.0, 0.01);
        EXPECT_EQ(views[shown].visibility, 1.0f);
        EXPECT_NEAR(views[behind].mean_kernel / kernel(hidden), 1.0, 0.01);
        EXPECT_EQ(views[behind].visibility, 0.0f);
    }
}

TEST(Hemicube, EveryValueIsInItsRange) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    builder.sphere({0.5, 0.5, 0.4}, 0.2, 20, Facing::outwards);
    const Model model(builder, 2);
    Hemicube hemicube(model.mesh, model.patches, 64);
    Random random(11, 8);
    for (int i = 0; i < 20; ++i) {
        const double x = random.next(), y = random.next();
        for (const PatchView& v : hemicube.look({x, y, 1.0}, turned_frame({0, 0, -1}, random))) {
            ASSERT_TRUE(std::isfinite(v.mean_kernel));
            ASSERT_GE(v.mean_kernel, 0.0f);
            ASSERT_GE(v.visibility, 0.0f);
            ASSERT_LE(v.visibility, 1.0f);
        }
    }
}

TEST(Hemicube, APatchGetsTheFluxOfItsParts) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    builder.sphere({0.5, 0.5, 0.4}, 0.2, 6, Facing::outwards);
    Model model(builder, 0);
    model.patches = random_hierarchy(std::vector<int>(model.mesh.triangles.size()), 2, 4);
    ASSERT_FALSE(model.patches.mixed_roots.empty());
    const SplitPatches parts = split_all_leaves(model.patches);
    Hemicube whole(model.mesh, model.patches, 512), split(model.mesh, parts.patches, 512);
    Random random(11, 9);
    int compared = 0;
    for (int i = 0; i < 4; ++i) {
        const double x = random.next(), y = random.next();
        const glm::dmat3 frame = turned_frame({0, 0, -1}, random);
        const auto flux = [&](Hemicube& hemicube, const PatchHierarchy& patches) {
            const auto& views = hemicube.look({x, y, 1.0}, frame);
            std::vector<double> values;
            for (std::uint32_t p = 0; p < patches.patch_count(); ++p)
                values.push_back(area_of_leaf(model.mesh, patches, patches.leaf_of_patch(p)) *
                                 views[p].mean_kernel * views[p].visibility);
            return values;
        };
        const auto expected = flux(whole, model.patches), of_parts = flux(split, parts.patches);
        std::vector<double> sums(expected.size());
        std::vector<double> smallest(expected.size(), 1.0);
        for (std::uint32_t p = 0; p < of_parts.size(); ++p) {
            const std::uint32_t parent = parts.parent[parts.patches.leaf_of_patch(p)] +
                                         (parts.patches.is_back(p) ? model.patches.leaf_count : 0);
            sums[parent] += of_parts[p];
            smallest[parent] = std::min(smallest[parent], of_parts[p]);
        }
        // Flux is kept where every part has dozens of pixels, of at most (2 / 512)^2 each. What
        // others get too much, or too little, all make up for in proportion.
        double ratio = 0.0;
        for (std::uint32_t p = 0; p < sums.size(); ++p) {
            if (smallest[p] < 64.0 * 4.0 / (512.0 * 512.0)) continue;
            if (ratio == 0.0) ratio = sums[p] / expected[p];
            EXPECT_NEAR(sums[p], ratio * expected[p], 1e-6 * expected[p]);
            ++compared;
        }
        EXPECT_NEAR(ratio, 1.0, 1e-3);
    }
    EXPECT_GT(compared, 100);
}

TEST(Hemicube, RefusesResolutionsItCannotDo) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    const Model model(builder, 0);
    for (const int bad : {-2, 0, 14, 17, 4098})
        EXPECT_THROW(Hemicube(model.mesh, model.patches, bad), UsageError);
    EXPECT_NO_THROW(Hemicube(model.mesh, model.patches, 16));
}

// Patches much smaller than a pixel, most of which no pixel's centre meets: about the outline, far
// ones are behind pixels that see past the ball.
TEST(Hemicube, DoesNotSeeIntoAClosedBody) {
    constexpr double radius = 0.4, distance = 1.0;
    constexpr int resolution = 64;
    SceneBuilder builder;
    builder.sphere({0, 0, distance}, radius, 64, Facing::outwards);
    const Model model(builder, 0);
    Hemicube hemicube(model.mesh, model.patches, resolution);
    Random random(7, 2);
    double outside = 0.0, inside = 0.0;
    for (int turn = 0; turn < turns; ++turn) {
        const auto& views = hemicube.look({0, 0, 0}, turned_frame({0, 0, 1}, random));
        for (std::uint32_t p = 0; p < model.patches.patch_count(); ++p) {
            const std::uint32_t leaf = model.patches.leaf_of_patch(p);
            (model.patches.is_back(p) ? inside : outside) +=
                area_of_leaf(model.mesh, model.patches, leaf) * views[p].mean_kernel *
                views[p].visibility;
        }
    }
    EXPECT_GT(outside, 0.0);
    // Pixels on the outline may be as far off as vertices are rounded: 2^-8 of a pixel.
    const double radius_in_pixels =
        0.5 * resolution * radius / std::sqrt(distance * distance - radius * radius);
    EXPECT_LE(inside, 2.0 / (radius_in_pixels * 0x1p8) * outside);
}

TEST(Hemicube, SeesAllAroundThroughACube) {
    SceneBuilder builder;
    builder.box({-1, -1, -1}, {1, 1, 1}, Facing::inwards);
    builder.box({0.2, 0.3, 0.1}, {0.6, 0.5, 0.8}, Facing::outwards);
    const Model model(builder, 2);
    Random random(5, 1);
    const glm::dvec3 axis(0, 0, 1), point(-0.2, 0.1, 0.3);
    const glm::dmat3 frame = turned_frame(axis, random);
    Hemicube hemicube(model.mesh, model.patches, 256);
    const auto sum = [&](const std::vector<PatchView>& views) {
        double seen = 0.0;
        for (std::uint32_t p = 0; p < model.patches.patch_count(); ++p)
            seen += area_of_leaf(model.mesh, model.patches, model.patches.leaf_of_patch(p)) *
                    views[p].mean_kernel * views[p].visibility;
        return seen;
    };
    const auto one = [](const glm::dvec3&) { return 1.0; };
    EXPECT_NEAR(sum(hemicube.look_around(point, frame, one)), 4.0 * pi, 4e-3 * pi);
    // The cosine, cut off at the horizon, is the hemicube's own.
    const auto cosine = [&](const glm::dvec3& d) { return std::max(0.0, glm::dot(d, axis)); };
    EXPECT_NEAR(sum(hemicube.look_around(point, frame, cosine)), pi, 1e-3 * pi);
    EXPECT_NEAR(sum(hemicube.look(point, frame)), pi, 1e-3 * pi);
    const auto none = [](const glm::dvec3&) { return 0.0; };
    EXPECT_EQ(sum(hemicube.look_around(point, frame, none)), 0.0);
}

}  // namespace
}  // namespace transillum
