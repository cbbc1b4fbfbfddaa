#include "support/scene_builder.h"

#include <transillum/base/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <limits>
#include <set>

namespace transillum {
namespace {

using testing::HasSubstr;
using testing_support::Facing;
using testing_support::Recorder;
using testing_support::SceneBuilder;

double total_area(const SurfaceMesh& mesh) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) sum += area_of(mesh, t);
    return sum;
}

TEST(BuildSurface, WeldsACubeAndKeepsItsSources) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::outwards);
    SurfaceReport report;
    const SurfaceMesh mesh = builder.surface({}, &report);
    EXPECT_EQ(report.polygons, 6u);
    EXPECT_EQ(report.triangles, 12u);
    EXPECT_EQ(report.welded, 24u - 8u);
    EXPECT_EQ(report.degenerate + report.duplicate + report.border_edges + report.nonmanifold_edges,
              0u);
    EXPECT_EQ(report.crease_edges, 12u);
    EXPECT_EQ(mesh.positions.size(), 8u);
    EXPECT_EQ(total_area(mesh), 6.0);
    std::multiset<std::uint32_t> faces;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        faces.insert(mesh.triangles[t].source_face);
        // Outwards: away from the middle.
        const glm::dvec3 corner = mesh.positions[mesh.triangles[t].vertices[0]];
        EXPECT_EQ(glm::dot(normal_of(mesh, t), corner - glm::dvec3(0.5)), 0.5);
    }
    for (std::uint32_t f = 0; f < 6; ++f) EXPECT_EQ(faces.count(f), 2u);
}

TEST(BuildSurface, WeldsWhatTheGridCannotTellApart) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    builder.polygon({{0, 0, 1e-14}, {1, 1, -1e-14}, {-1e-14, 1, 0}});
    EXPECT_EQ(builder.surface().positions.size(), 4u);
    builder.polygon({{0, 0, 1e-10}, {1, 0, 1e-10}, {1, 1, 1e-10}});
    EXPECT_EQ(builder.surface().positions.size(), 7u);
}

TEST(BuildSurface, DropsTrianglesWithoutArea) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}});
    builder.polygon({{0, 0, 0}, {0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}});
    builder.polygon({{0, 0, 0}, {0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}, {0.75, 0.75, 0.75}});
    builder.polygon({{0, 0, 0}, {1, 0, 0}});
    SurfaceReport report;
    Recorder recorder;
    const SurfaceMesh mesh = build_surface(builder.scene, {}, recorder, &report);
    EXPECT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(report.degenerate, 4u);
    ASSERT_EQ(recorder.notes.size(), 1u);
    EXPECT_THAT(recorder.notes[0], HasSubstr("4 triangles without area"));
}

/// Neighbouring Fibonacci numbers span an area of one grid cell, which double cannot see.
TEST(BuildSurface, NeverKeepsATriangleWithoutANormal) {
    constexpr double f57 = 365435296162.0, f58 = 591286729879.0, f59 = 956722026041.0;
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {f58, f59, 0}, {f57, f58, 0}});
    builder.polygon({{0, 0, 0}, {f59, 0, 0}, {0, f59, 0}});
    const SurfaceMesh mesh = builder.surface();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        EXPECT_GT(area_of(mesh, t), 0.0);
        EXPECT_NEAR(glm::length(normal_of(mesh, t)), 1.0, 1e-15);
    }
}

TEST(BuildSurface, DropsRepeatedFacesButKeepsOppositeOnes) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    builder.polygon({{0, 1, 0}, {0, 0, 0}, {1, 0, 0}});
    builder.polygon({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}});
    SurfaceReport report;
    Recorder recorder;
    const SurfaceMesh mesh = build_surface(builder.scene, {}, recorder, &report);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(report.duplicate, 1u);
    EXPECT_EQ(mesh.triangles[0].source_face, 0u);
    EXPECT_EQ(mesh.triangles[1].source_face, 2u);
    EXPECT_EQ(normal_of(mesh, 0), -normal_of(mesh, 1));
    ASSERT_EQ(recorder.notes.size(), 1u);
    EXPECT_THAT(recorder.notes[0], HasSubstr("1 triangles that repeat"));
}

/// A wall with a window, as modellers export it: one outline joined to the hole by a seam.
TEST(BuildSurface, KeepsAWindowOpen) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0},
                     {0, 3, 0},
                     {0, 3, 3},
                     {0, 0, 3},
                     {0, 0, 0},
                     {0, 1, 1},
                     {0, 1, 2},
                     {0, 2, 2},
                     {0, 2, 1},
                     {0, 1, 1}});
    SurfaceReport report;
    const SurfaceMesh mesh = builder.surface({}, &report);
    EXPECT_EQ(total_area(mesh), 8.0);
    EXPECT_EQ(report.triangles, 8u);
    EXPECT_EQ(report.border_edges, 8u);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        EXPECT_EQ(normal_of(mesh, t), glm::dvec3(1, 0, 0));
}

TEST(BuildSurface, TextureCoordinatesFollowTheCorners) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}});  // dropped
    builder.polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0.5, 0}, {0, 1, 0}});
    for (const std::uint32_t c : builder.scene.corners)
        builder.scene.uvs.emplace_back(builder.scene.positions[c].x, builder.scene.positions[c].y);
    const SurfaceMesh mesh = builder.surface();
    ASSERT_EQ(mesh.uvs.size(), 3 * mesh.triangles.size());
    ASSERT_EQ(mesh.triangles.size(), 3u);
    for (std::size_t c = 0; c < mesh.uvs.size(); ++c)
        EXPECT_EQ(glm::dvec2(mesh.uvs[c]),
                  glm::dvec2(mesh.positions[mesh.triangles[c / 3].vertices[c % 3]]));
}

TEST(BuildSurface, FarAwayScenesLoseNoMoreThanTheGrid) {
    SceneBuilder near, far;
    near.sphere({0, 0, 0}, 1.0, 16, Facing::outwards);
    far.sphere({1e6, 1e6, -1e6}, 1.0, 16, Facing::outwards);
    SurfaceReport near_report, far_report;
    const SurfaceMesh a = near.surface({}, &near_report), b = far.surface({}, &far_report);
    EXPECT_EQ(near_report.triangles, far_report.triangles);
    EXPECT_EQ(a.positions.size(), b.positions.size());
    EXPECT_EQ(a.fan_count, b.fan_count);
    EXPECT_EQ(b.grid.exponent, 20 - 40);
    // A corner moves by at most the reported length; edges are below 2 pi / 16.
    const double triangles = static_cast<double>(a.triangles.size());
    EXPECT_NEAR(total_area(b), total_area(a), triangles * 2.0 * (b.grid.largest_move + 1e-9));
    EXPECT_NE(total_area(b), total_area(a));
}

TEST(BuildSurface, PowersOfTwoScaleExactly) {
    SceneBuilder unit, small;
    unit.sphere({0.3, 0.1, 0.2}, 1.0, 12, Facing::inwards);
    small.sphere({0.3, 0.1, 0.2}, 1.0, 12, Facing::inwards);
    for (glm::dvec3& p : small.scene.positions) p *= 0x1p-10;
    const SurfaceMesh a = unit.surface(), b = small.surface();
    ASSERT_EQ(a.positions.size(), b.positions.size());
    for (std::size_t i = 0; i < a.positions.size(); ++i)
        EXPECT_EQ(a.positions[i] * 0x1p-10, b.positions[i]);
    for (std::size_t t = 0; t < a.triangles.size(); ++t)
        EXPECT_EQ(a.triangles[t].vertices, b.triangles[t].vertices);
}

TEST(BuildSurface, RefusesScenesWithoutATriangle) {
    SceneBuilder empty;
    EXPECT_THROW((void)empty.surface(), InputError);
    SceneBuilder flat;
    flat.scene.path = "flat.obj";
    flat.polygon({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
    try {
        (void)flat.surface();
        FAIL();
    } catch (const InputError& e) {
        EXPECT_THAT(e.what(), HasSubstr("flat.obj"));
    }
}

TEST(BuildSurface, RefusesPositionsThatAreNoNumbers) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        SceneBuilder builder;
        builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        builder.polygon({{0, 0, 0}, {1, 0, bad}, {0, 1, 0}});
        EXPECT_THROW((void)builder.surface(), InputError);
    }
}

}  // namespace
}  // namespace transillum
