#include "support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

namespace transillum {
namespace {

using testing_support::Facing;
using testing_support::SceneBuilder;

/// Fan numbers are dense, and corners of one fan lie on one vertex.
void expect_consistent(const SurfaceMesh& mesh) {
    std::vector<std::set<std::uint32_t>> vertices(mesh.fan_count);
    for (const RootTriangle& t : mesh.triangles)
        for (int c = 0; c < 3; ++c) {
            ASSERT_LT(t.fans[c], mesh.fan_count);
            vertices[t.fans[c]].insert(t.vertices[c]);
        }
    for (const auto& v : vertices) EXPECT_EQ(v.size(), 1u);
}

/// Two unit squares side by side.
SceneBuilder squares() {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    builder.polygon({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});
    return builder;
}

TEST(FindFans, ACubeHasOneACornerOfEveryFace) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    const SurfaceMesh mesh = builder.surface();
    expect_consistent(mesh);
    EXPECT_EQ(mesh.fan_count, 24u);
    EXPECT_EQ(builder.surface({.crease_angle = 91.0}).fan_count, 8u);
}

TEST(FindFans, ASphereHasOneAVertex) {
    SceneBuilder builder;
    builder.sphere({1, 2, 3}, 2.0, 24, Facing::outwards);
    SurfaceReport report;
    const SurfaceMesh mesh = builder.surface({}, &report);
    expect_consistent(mesh);
    EXPECT_EQ(mesh.fan_count, mesh.positions.size());
    EXPECT_EQ(report.border_edges + report.crease_edges + report.nonmanifold_edges, 0u);
    EXPECT_GT(builder.surface({.crease_angle = 0.01}).fan_count, mesh.fan_count);
}

TEST(FindFans, MaterialsAndObjectsAreNotJoined) {
    EXPECT_EQ(squares().surface().fan_count, 6u);
    SceneBuilder materials = squares();
    materials.scene.polygons[1].material = materials.material(Spectrum(0.1f));
    EXPECT_EQ(materials.surface().fan_count, 8u);
    SceneBuilder objects = squares();
    objects.scene.objects.push_back("other");
    objects.scene.polygons[1].object = 1;
    EXPECT_EQ(objects.surface().fan_count, 8u);
}

TEST(FindFans, FacesWoundAgainstEachOtherAreNotJoined) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    builder.polygon({{1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 0, 0}});
    SurfaceReport report;
    const SurfaceMesh mesh = builder.surface({}, &report);
    expect_consistent(mesh);
    EXPECT_GE(mesh.fan_count, 8u);
    EXPECT_EQ(report.nonmanifold_edges, 0u);
}

/// Whichever face is met first, the three that meet in an edge never come together.
TEST(FindFans, AnEdgeOfThreeFacesJoinsNone) {
    for (int order = 0; order < 3; ++order) {
        SceneBuilder builder = squares();
        // Lifted a little: it would be no crease either.
        builder.polygon({{1, 0, 0}, {2, 0, 0.1}, {2, 1, 0.1}, {1, 1, 0}});
        auto& polygons = builder.scene.polygons;
        std::rotate(polygons.begin(), polygons.begin() + order, polygons.end());
        SurfaceReport report;
        const SurfaceMesh mesh = builder.surface({}, &report);
        expect_consistent(mesh);
        EXPECT_EQ(report.nonmanifold_edges, 1u);
        std::vector<std::set<std::uint32_t>> faces(mesh.fan_count);
        for (const RootTriangle& t : mesh.triangles)
            for (const std::uint32_t fan : t.fans) faces[fan].insert(t.source_face);
        for (const auto& f : faces) EXPECT_EQ(f.size(), 1u) << "order " << order;
    }
}

/// A cone's side as seen from its tip: its faces share the tip and no more with the other cone's.
void add_cone(SceneBuilder& builder, double height, int first, int last) {
    constexpr int n = 12;
    const auto rim = [&](int i) {
        const double phi = 2.0 * std::numbers::pi * (i % n) / n;
        return glm::dvec3(std::cos(phi), std::sin(phi), height);
    };
    for (int i = first; i < last; ++i) builder.polygon({{0, 0, 0}, rim(i), rim(i + 1)});
}

/// Two flat cones touch at their tips, which no half-edge structure can hold in one vertex. Some
/// face is cut off then; which, follows from the order.
TEST(FindFans, TwoConesThatTouchKeepTheirOwnTips) {
    for (const int split : {1, 6, 11, 12}) {
        SceneBuilder builder;
        add_cone(builder, 0.1, 0, split);
        add_cone(builder, -0.1, 0, 12);
        add_cone(builder, 0.1, split, 12);
        testing::internal::CaptureStderr();
        const SurfaceMesh mesh = builder.surface();
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
        expect_consistent(mesh);
        EXPECT_GE(mesh.fan_count, 2u + 24u);
        std::vector<std::set<bool>> cones(mesh.fan_count);
        for (const RootTriangle& t : mesh.triangles)
            for (const std::uint32_t fan : t.fans) {
                const auto face = static_cast<int>(t.source_face);
                cones[fan].insert(face >= split && face < split + 12);
            }
        for (const auto& c : cones) EXPECT_EQ(c.size(), 1u) << "split after " << split;
    }
}

/// A strip with a half turn: its faces agree everywhere but at one seam.
TEST(FindFans, AMoebiusStripIsCutOnceAtItsSeam) {
    constexpr int n = 40;
    SceneBuilder builder;
    const auto at = [&](int i, double across) {
        const double phi = 2.0 * std::numbers::pi * i / n;
        const double r = 3.0 + across * std::cos(phi / 2.0);
        return glm::dvec3(r * std::cos(phi), r * std::sin(phi), across * std::sin(phi / 2.0));
    };
    for (int i = 0; i < n; ++i) {
        const bool seam = i + 1 == n;
        builder.polygon({at(i, -1), at(i, 1), seam ? at(0, -1) : at(i + 1, 1),
                         seam ? at(0, 1) : at(i + 1, -1)});
    }
    SurfaceReport report;
    const SurfaceMesh mesh = builder.surface({}, &report);
    expect_consistent(mesh);
    EXPECT_EQ(mesh.positions.size(), 2u * n);
    EXPECT_EQ(report.nonmanifold_edges, 0u);
    // Two vertices lie on the seam; the triangle that cannot be linked may lose its other joints
    // too.
    EXPECT_GE(mesh.fan_count, 2u * n + 2u);
    EXPECT_LE(mesh.fan_count, 2u * n + 4u);
}

}  // namespace
}  // namespace transillum
