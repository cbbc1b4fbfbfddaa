#include "support/scene_builder.h"

#include <transillum/base/error.h>
#include <transillum/first_shot/light_samples.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace transillum {
namespace {

using namespace testing_support;
const Spectrum bright(3.0f, 2.0f, 1.0f);

/// A room of 4 x 4 x 4 with nothing that emits, so that lamps are small beside it.
SceneBuilder room() {
    SceneBuilder builder;
    builder.box({-2, -2, 0}, {2, 2, 4}, Facing::inwards);
    return builder;
}

void add_lamp(SceneBuilder& builder, double x, std::uint32_t material, double z = 3.0) {
    builder.polygon({{x, 0, z}, {x, 0.3, z}, {x + 0.2, 0.3, z}, {x + 0.2, 0, z}}, material);
}

double sum_of_areas(const Luminaires& l) {
    double sum = 0.0;
    for (const LightSample& s : l.samples) sum += s.area;
    return sum;
}

/// Samples lie on their root, with its normal or the opposite one, its radiance, and equal areas.
void expect_on_their_roots(const SurfaceMesh& mesh, const Luminaires& l) {
    for (const LightSample& s : l.samples) {
        const auto& v = mesh.triangles.at(s.root).vertices;
        const glm::dvec3 n = normal_of(mesh, s.root);
        EXPECT_NEAR(glm::dot(s.position - mesh.positions[v[0]], n), 0.0, 1e-14);
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 edge = mesh.positions[v[(i + 1) % 3]] - mesh.positions[v[i]];
            EXPECT_GT(glm::dot(glm::cross(edge, s.position - mesh.positions[v[i]]), n), 0.0);
        }
        EXPECT_EQ(s.normal, s.back ? -n : n);
        EXPECT_EQ(s.emitted, mesh.materials[mesh.triangles[s.root].material].emission);
        EXPECT_EQ(l.shot_sides[2 * s.root + (s.back ? 1 : 0)], 1);
    }
}

TEST(SampleLuminaires, AQuadIsOne) {
    SceneBuilder builder = room();
    add_lamp(builder, 0, builder.material(Spectrum(0.0f), bright));
    const SurfaceMesh mesh = builder.surface();
    const Luminaires l = sample_luminaires(mesh, {});
    EXPECT_EQ(l.count, 1u);
    EXPECT_EQ(l.shot, 1u);
    EXPECT_EQ(l.samples.size(), 64u);
    EXPECT_EQ(l.largest_share, 0.0);
    EXPECT_NEAR(sum_of_areas(l), 0.06, 1e-12);
    for (const LightSample& s : l.samples) {
        EXPECT_DOUBLE_EQ(s.area, l.samples[0].area);
        EXPECT_FALSE(s.back);
        EXPECT_NEAR(s.normal.z, -1.0, 1e-15);
    }
    expect_on_their_roots(mesh, l);
    ASSERT_EQ(l.shot_sides.size(), 2 * mesh.triangles.size());
    for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r) {
        EXPECT_EQ(l.shot_sides[2 * r], mesh.triangles[r].source_face == 6 ? 1 : 0);
        EXPECT_EQ(l.shot_sides[2 * r + 1], 0);
    }
}

TEST(SampleLuminaires, AClosedBulbIsOne) {
    SceneBuilder builder = room();
    builder.sphere({0, 0, 2}, 0.25, 20, Facing::outwards, builder.material(Spectrum(0.0f), bright));
    const SurfaceMesh mesh = builder.surface();
    const Luminaires l = sample_luminaires(mesh, {.samples = 256});
    EXPECT_EQ(l.count, 1u);
    ASSERT_EQ(l.samples.size(), 256u);
    double surface = 0.0;
    for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r)
        surface += l.shot_sides[2 * r] ? area_of(mesh, r) : 0.0;
    EXPECT_NEAR(sum_of_areas(l), surface, 1e-12);
    expect_on_their_roots(mesh, l);
    // Outwards, and strewn evenly: the mean normal is within the four standard errors of random
    // ones.
    glm::dvec3 mean(0.0);
    for (const LightSample& s : l.samples) {
        EXPECT_GT(glm::dot(s.normal, s.position - glm::dvec3(0, 0, 2)), 0.2);
        mean += s.normal / 256.0;
    }
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(mean[axis], 0.0, 4.0 / std::sqrt(3.0 * 256.0));
}

TEST(SampleLuminaires, LampsApartAreTwoAndSoAreTwoMaterials) {
    SceneBuilder apart = room();
    const std::uint32_t m = apart.material(Spectrum(0.0f), bright);
    add_lamp(apart, 0, m);
    add_lamp(apart, 1, m);
    EXPECT_EQ(sample_luminaires(apart.surface(), {}).count, 2u);
    SceneBuilder touching = room();
    const std::uint32_t a = touching.material(Spectrum(0.0f), bright),
                        b = touching.material(Spectrum(0.0f), Spectrum(1.0f));
    add_lamp(touching, 0, a);
    add_lamp(touching, 0.2, a);
    EXPECT_EQ(sample_luminaires(touching.surface(), {}).count, 1u);
    add_lamp(touching, 0.4, b);
    EXPECT_EQ(sample_luminaires(touching.surface(), {}).count, 2u);
}

TEST(SampleLuminaires, BothSidesOfASheetAreTwo) {
    SceneBuilder builder = room();
    const std::uint32_t m = builder.material(Spectrum(0.0f), bright);
    builder.scene.materials[m].back_emits = true;
    add_lamp(builder, 0, m);
    const SurfaceMesh mesh = builder.surface();
    const Luminaires l = sample_luminaires(mesh, {.samples = 16});
    EXPECT_EQ(l.count, 2u);
    EXPECT_EQ(l.samples.size(), 32u);
    EXPECT_EQ(std::ranges::count_if(l.samples, &LightSample::back), 16);
    EXPECT_NEAR(sum_of_areas(l), 0.12, 1e-12);
    expect_on_their_roots(mesh, l);
    EXPECT_EQ(std::ranges::count(l.shot_sides, 1), 4);
}

TEST(SampleLuminaires, TakesFewerSamplesEachWhereThereAreMany) {
    for (const auto& [lamps, each] : std::vector<std::pair<int, int>>{{1, 64},
                                                                      {2, 64},
                                                                      {3, 32},
                                                                      {8, 16},
                                                                      {9, 8},
                                                                      {16, 8},
                                                                      {24, 8},
                                                                      {32, 8},
                                                                      {33, 4},
                                                                      {60, 4}}) {
        SceneBuilder builder = room();
        const std::uint32_t m = builder.material(Spectrum(0.0f), bright);
        for (int i = 0; i < lamps; ++i)
            add_lamp(builder, -1.5 + 0.3 * (i % 10), m, 1.0 + 0.3 * (i / 10));
        const Luminaires l = sample_luminaires(builder.surface(), {});
        EXPECT_EQ(l.count, static_cast<std::uint32_t>(lamps));
        EXPECT_EQ(l.samples.size(), static_cast<std::size_t>(lamps * each)) << lamps << " lamps";
    }
}

/// Each triangle of a quad of unequal halves gets its share of samples.
TEST(SampleLuminaires, SamplesAreStratifiedByArea) {
    SceneBuilder builder = room();
    builder.polygon({{0, 0, 3}, {0, 0.4, 3}, {0.1, 0.1, 3}, {0.1, 0, 3}},
                    builder.material(Spectrum(0.0f), bright));
    const SurfaceMesh mesh = builder.surface();
    for (const int count : {1, 7, 64, 4096}) {
        const Luminaires l = sample_luminaires(mesh, {.samples = count});
        ASSERT_EQ(l.samples.size(), static_cast<std::size_t>(count));
        double total = 0.0;
        for (std::uint32_t r = 12; r < mesh.triangles.size(); ++r) total += area_of(mesh, r);
        for (std::uint32_t r = 12; r < mesh.triangles.size(); ++r) {
            const auto here = std::ranges::count(l.samples, r, &LightSample::root);
            EXPECT_NEAR(static_cast<double>(here), count * area_of(mesh, r) / total, 1.0);
        }
    }
}

TEST(SampleLuminaires, SeedsMoveTheSamples) {
    SceneBuilder builder = room();
    add_lamp(builder, 0, builder.material(Spectrum(0.0f), bright));
    const SurfaceMesh mesh = builder.surface();
    const auto first = [&](std::uint64_t seed) {
        return sample_luminaires(mesh, {.seed = seed}).samples[0].position;
    };
    EXPECT_EQ(first(1), first(1));
    EXPECT_NE(first(1), first(2));
}

TEST(SampleLuminaires, LeavesLargeOnesToTheIteration) {
    SceneBuilder builder = room();
    const std::uint32_t m = builder.material(Spectrum(0.0f), bright);
    builder.scene.polygons[1].material = m;  // the ceiling, a sixth of the room
    add_lamp(builder, 0, m);
    const SurfaceMesh mesh = builder.surface();
    const Luminaires automatic = sample_luminaires(mesh, {});
    EXPECT_EQ(automatic.count, 2u);
    EXPECT_EQ(automatic.shot, 1u);
    EXPECT_NEAR(automatic.largest_share, 16.0 / 96.06, 1e-12);
    EXPECT_NEAR(sum_of_areas(automatic), 0.06, 1e-12);
    for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r)
        EXPECT_EQ(automatic.shot_sides[2 * r], mesh.triangles[r].source_face == 6 ? 1 : 0);

    const Luminaires all = sample_luminaires(mesh, {.first_shot = FirstShot::hemicube});
    EXPECT_EQ(all.shot, 2u);
    EXPECT_EQ(all.largest_share, 0.0);
    EXPECT_NEAR(sum_of_areas(all), 16.06, 1e-11);

    const Luminaires none = sample_luminaires(mesh, {.first_shot = FirstShot::off});
    EXPECT_EQ(none.count, 2u);
    EXPECT_EQ(none.shot, 0u);
    EXPECT_TRUE(none.samples.empty());
    EXPECT_EQ(std::ranges::count(none.shot_sides, 0), std::ssize(none.shot_sides));

    EXPECT_EQ(sample_luminaires(mesh, {.large_emitter = 0.0001}).shot, 0u);
    EXPECT_EQ(sample_luminaires(mesh, {.large_emitter = 0.2}).shot, 2u);
}

TEST(SampleLuminaires, NothingEmitsNothing) {
    const SurfaceMesh mesh = room().surface();
    const Luminaires l = sample_luminaires(mesh, {});
    EXPECT_EQ(l.count, 0u);
    EXPECT_TRUE(l.samples.empty());
    EXPECT_EQ(l.shot_sides.size(), 2 * mesh.triangles.size());
}

TEST(SampleLuminaires, RefusesCountsOutsideTheirRange) {
    const SurfaceMesh mesh = room().surface();
    EXPECT_THROW((void)sample_luminaires(mesh, {.samples = -1}), UsageError);
    EXPECT_THROW((void)sample_luminaires(mesh, {.samples = 4097}), UsageError);
}

}  // namespace
}  // namespace transillum
