// A solution as triangles with vertex colours.
#include "support/random_hierarchy.h"
#include "unit/render/dark_solution.h"
#include "unit/render/surface_builder.h"

#include <transillum/render/make_radiance_mesh.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace transillum {
namespace {

using testing_support::dark_solution;
using testing_support::random_hierarchy;
using testing_support::SurfaceBuilder;

constexpr float albedo = 0.5f;

/// A square of 3 x 3 smooth quads in the plane z = x / 4; a linear irradiance on its front.
SpectralSolution lit_square(const std::vector<int>& levels, int rounds, std::uint64_t seed) {
    SurfaceBuilder builder;
    const auto grey = builder.material(Spectrum(albedo));
    builder[grey].back_reflects = true;
    const auto at = [](int i, int j) { return glm::dvec3(i, j, 0.25 * i); };
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            builder.quad({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, grey, 0);
    SpectralSolution spectral;
    Solution& s = spectral.rgb;
    s = dark_solution(builder.build(), 0);
    s.surface.objects = {"square"};
    s.patches = random_hierarchy(levels, rounds, seed);
    for (auto* values : {&s.direct_irradiance, &s.indirect_irradiance, &s.standard_error})
        values->assign(s.patches.patch_count(), Spectrum(0.0f));
    s.coverage.assign(s.patches.patch_count(), 1.0f);
    for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf)
        s.indirect_irradiance[leaf] =
            Spectrum(1.0 + leaf_centre(s.surface, s.patches, leaf).x, 2.0, 3.0);
    return spectral;
}

RadianceMeshOptions flat() {
    RadianceMeshOptions options;
    options.interpolate = false;
    return options;
}

RadianceMeshOptions exposed(double stops) {
    RadianceMeshOptions options;
    options.tone = {stops, false};
    return options;
}

SpectralSolution random_square(std::uint64_t seed) {
    return lit_square(std::vector<int>(18, 1), 3, seed);
}

glm::dvec3 area_vector(const RadianceMesh& mesh, const RadianceMesh::Triangle& t) {
    const glm::dvec3 a = mesh.positions[t.vertices[0]];
    return 0.5 * glm::cross(mesh.positions[t.vertices[1]] - a, mesh.positions[t.vertices[2]] - a);
}

TEST(RadianceMesh, HoldsALinearFieldAtEveryVertex) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const RadianceMesh mesh = make_radiance_mesh(random_square(seed), {}, Workers(2));
        ASSERT_GT(mesh.positions.size(), 100u);
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const double red = albedo * (1.0 + mesh.positions[v].x) / std::numbers::pi;
            EXPECT_NEAR(mesh.radiance[v].x, red, 1e-5 * 4.0) << v;
            EXPECT_NEAR(mesh.radiance[v].y, albedo * 2.0 / std::numbers::pi, 1e-5) << v;
        }
    }
}

// Where leaves differ in size the larger one takes part in the vertices of the smaller: every edge
// within the surface has two sides.
TEST(RadianceMesh, HasNoTJunctions) {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        const RadianceMesh mesh = make_radiance_mesh(random_square(seed), {}, Workers(2));
        std::set<Edge> edges;
        for (const auto& t : mesh.triangles)
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_TRUE(edges.insert({t.vertices[c], t.vertices[(c + 1) % 3]}).second);
        for (const auto& [from, to] : edges) {
            const glm::dvec3 a = mesh.positions[from], b = mesh.positions[to];
            const bool on_border = (a.x == b.x && (a.x == 0.0 || a.x == 3.0)) ||
                                   (a.y == b.y && (a.y == 0.0 || a.y == 3.0));
            EXPECT_TRUE(on_border || edges.contains({to, from})) << seed;
        }
    }
}

/// Two squares at a right angle, each with leaves of its own size: no vertex lies within an edge.
TEST(RadianceMesh, HasNoTJunctionsAtCreases) {
    SurfaceBuilder builder;
    const auto grey = builder.material(Spectrum(albedo));
    builder.quad({glm::dvec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, grey, 0);
    builder.quad({glm::dvec3(0, 0, 0), {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, grey, 1);
    SpectralSolution spectral;
    Solution& s = spectral.rgb;
    s = dark_solution(builder.build(), 0);
    s.surface.objects = {"corner"};
    s.patches = subdivide_to_levels({1, 1, 3, 2});
    for (auto* values : {&s.direct_irradiance, &s.indirect_irradiance, &s.standard_error})
        values->assign(s.patches.patch_count(), Spectrum(0.0f));
    s.coverage.assign(s.patches.patch_count(), 1.0f);
    for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf)
        s.indirect_irradiance[leaf] =
            Spectrum(static_cast<float>(1.0 + leaf_centre(s.surface, s.patches, leaf).x));
    for (const bool interpolate : {true, false}) {
        RadianceMeshOptions options;
        options.interpolate = interpolate;
        const RadianceMesh mesh = make_radiance_mesh(spectral, options, Workers(1));
        double area = 0.0;
        for (const auto& t : mesh.triangles) {
            area += glm::length(area_vector(mesh, t));
            for (std::size_t c = 0; c < 3; ++c) {
                const glm::dvec3 a = mesh.positions[t.vertices[c]];
                const glm::dvec3 b = mesh.positions[t.vertices[(c + 1) % 3]];
                for (const glm::dvec3& p : mesh.positions) {
                    if (p == a || p == b) continue;
                    const double off = glm::length(glm::cross(b - a, p - a));
                    const double along = glm::dot(b - a, p - a) / glm::dot(b - a, b - a);
                    EXPECT_FALSE(off < 1e-12 && along > 0.0 && along < 1.0);
                }
            }
        }
        EXPECT_NEAR(area, 2.0, 1e-12);
        if (!interpolate) continue;
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            EXPECT_NEAR(mesh.radiance[v].x, albedo * (1.0 + mesh.positions[v].x) / std::numbers::pi,
                        1e-5);
    }
}

TEST(RadianceMesh, CoversTheLitSideFacingOutOfIt) {
    SpectralSolution spectral = random_square(1);
    const glm::dvec3 front = normal_of(spectral.rgb.surface, 0);
    const double area = 9.0 * std::sqrt(1.0 + 0.25 * 0.25);
    for (const bool back : {false, true}) {
        if (back) {
            Solution& s = spectral.rgb;
            const std::uint32_t n = s.patches.leaf_count;
            for (std::uint32_t leaf = 0; leaf < n; ++leaf)
                std::swap(s.indirect_irradiance[leaf], s.indirect_irradiance[n + leaf]);
        }
        for (const bool interpolate : {false, true}) {
            const RadianceMesh mesh = make_radiance_mesh(
                spectral, interpolate ? RadianceMeshOptions{} : flat(), Workers(1));
            double sum = 0.0;
            for (const auto& t : mesh.triangles) {
                const double towards = glm::dot(area_vector(mesh, t), front);
                EXPECT_GT(back ? -towards : towards, 0.0);
                sum += std::abs(towards);
            }
            EXPECT_NEAR(sum, area, 1e-12 * area);
        }
    }
}

TEST(RadianceMesh, KeepsTheFluxWhereNothingIsInterpolated) {
    const SpectralSolution spectral = random_square(7);
    const Solution& s = spectral.rgb;
    const RadianceMesh mesh = make_radiance_mesh(spectral, flat(), Workers(2));
    double flux = 0.0, expected = 0.0;
    for (const auto& t : mesh.triangles) {
        flux += glm::length(area_vector(mesh, t)) * mesh.radiance[t.vertices[0]].x;
        EXPECT_EQ(mesh.radiance[t.vertices[0]], mesh.radiance[t.vertices[2]]);
    }
    for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf)
        expected += area_of_leaf(s.surface, s.patches, leaf) * s.finite_element_radiance(leaf).x;
    EXPECT_NEAR(flux, expected, 1e-6 * expected);
}

TEST(RadianceMesh, LeavesOutComponents) {
    SpectralSolution spectral = random_square(1);
    spectral.rgb.direct_irradiance.assign(spectral.rgb.patches.patch_count(), Spectrum(1.0f));
    RadianceMeshOptions only_direct;
    only_direct.components = {false, true, false, false};
    const RadianceMesh direct = make_radiance_mesh(spectral, only_direct, Workers(1));
    for (const Spectrum& radiance : direct.radiance)
        EXPECT_NEAR(radiance.y, albedo / std::numbers::pi, 1e-6);
    const RadianceMesh all = make_radiance_mesh(spectral, {}, Workers(1));
    // Backs are lit, too, by the direct light alone.
    EXPECT_EQ(all.triangles.size(), direct.triangles.size());
    EXPECT_NEAR(all.radiance.front().y, albedo * 3.0 / std::numbers::pi, 1e-5);
    EXPECT_NEAR(all.radiance.back().y, albedo / std::numbers::pi, 1e-6);
}

TEST(RadianceMesh, IsExposedToTheMedianOrAsAskedFor) {
    const SpectralSolution spectral = random_square(1);
    const RadianceMesh asked = make_radiance_mesh(spectral, exposed(-4.0), Workers(1));
    EXPECT_EQ(asked.exposure, -4.0);
    for (std::size_t v = 0; v < asked.display.size(); ++v)
        EXPECT_EQ(asked.display[v], asked.radiance[v] / 16.0f) << "darker than highlights";
    const RadianceMesh bright = make_radiance_mesh(spectral, exposed(20.0), Workers(1));
    for (const Spectrum& display : bright.display) EXPECT_LE(max_channel(display), 1.0f);
}

TEST(RadianceMesh, DoesNotDependOnTheNumberOfThreads) {
    const SpectralSolution spectral = random_square(1);
    const RadianceMesh one = make_radiance_mesh(spectral, {}, Workers(1));
    const RadianceMesh three = make_radiance_mesh(spectral, {}, Workers(3));
    EXPECT_EQ(one.radiance, three.radiance);
    EXPECT_EQ(one.display, three.display);
}

}  // namespace
}  // namespace transillum
