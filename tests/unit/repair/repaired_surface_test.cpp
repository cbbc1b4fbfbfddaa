// A repaired surface is where the surface was, and covers the same area.
#include <transillum/repair/repair_scene.h>
#include <transillum/scene/load_scene.h>

#include "support/scene_builder.h"
#include "support/surface_distance.h"
#include "support/union_area.h"
#include "unit/repair/random_soups.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <filesystem>
#include <numbers>

namespace transillum {
namespace {

using namespace testing_support;

TriangleSoup rectangle(double x0, double y0, double x1, double y1, double z = 0.0) {
    SceneBuilder b;
    b.polygon({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}});
    return make_soup(b.scene);
}

TEST(SurfaceDistance, IsThatOfTheFarthestPoint) {
    const Workers workers(2);
    const TriangleSoup a = rectangle(0, 0, 1, 1), part = rectangle(0, 0, 0.75, 1);
    const SurfaceDistance apart = surface_distance(a, rectangle(0, 0, 1, 1, 0.5), 1000, workers);
    EXPECT_EQ(apart.forth, 0.5);
    EXPECT_EQ(apart.back, 0.5);
    EXPECT_GT(apart.samples, 2000u);
    const SurfaceDistance missing = surface_distance(a, part, 1000, workers);
    EXPECT_EQ(missing.forth, 0.25);
    EXPECT_LT(missing.back, 1e-16);
}

// Needles of 1 : 1e12, whose planes doubles can't tell.
TEST(SurfaceDistance, HoldsForNeedles) {
    SceneBuilder b;
    b.polygon({{0.1, 0.2, 0.3}, {1.7, 1.3, 2.9}, {0.7, 0.5, 1.1 + 1e-12}});
    const TriangleSoup needle = make_soup(b.scene);
    EXPECT_LT(surface_distance(needle, needle, 1000, Workers(2)).forth, 4e-16);
}

TEST(UnionArea, CountsOverlapsOnce) {
    SceneBuilder b;
    b.polygon({{0, 0, 0}, {2, 0, 2}, {2, 2, 2}, {0, 2, 0}});
    b.polygon({{1, 1, 1}, {1, 3, 1}, {3, 3, 3}, {3, 1, 3}});  // faces the other way
    b.polygon({{0, 0, 1}, {2, 0, 3}, {2, 2, 3}, {0, 2, 1}});  // parallel
    const UnionArea area = union_area(make_soup(b.scene));
    EXPECT_NEAR(area.covered, 11.0 * std::numbers::sqrt2, 1e-14);
    EXPECT_NEAR(area.sum, 12.0 * std::numbers::sqrt2, 1e-14);
    EXPECT_EQ(area.clusters, 1u);
    EXPECT_LE(area.overlapping, 4u);
}

TEST(UnionArea, LeavesHolesOpen) {
    SceneBuilder b;  // a frame of four strips that overlap in its corners
    b.polygon({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}});
    b.polygon({{0, 2, 0}, {3, 2, 0}, {3, 3, 0}, {0, 3, 0}});
    b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 3, 0}, {0, 3, 0}});
    b.polygon({{2, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}});
    EXPECT_EQ(union_area(make_soup(b.scene)).covered, 8.0);
}

TEST(UnionArea, CountsOnceWhatOverlapsWithinATolerance) {
    SceneBuilder b;
    b.polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
    b.polygon({{1, 0, 1e-9}, {3, 0, 2e-9}, {3, 1, 2e-9}, {1, 1, 1e-9}});
    EXPECT_NEAR(union_area(make_soup(b.scene)).covered, 4.0, 1e-15);
    EXPECT_NEAR(union_area(make_soup(b.scene), 4e-9).covered, 3.0, 1e-15);
}

struct Kept {
    double distance = 0.0;  ///< over the diagonal
    double area = 0.0;      ///< change over that before
    double move = 0.0;      ///< largest, over the diagonal
    UnionArea before;
};

Kept repair_and_compare(const Scene& scene, bool close_cracks) {
    Monitor silent;
    const Workers workers(2);
    RepairOptions options;
    options.close_cracks = close_cracks;
    const RepairedScene repaired = repair_scene(scene, options, workers, silent);
    const TriangleSoup was = make_soup(scene), is = make_soup(repaired.scene);
    const SurfaceDistance d = surface_distance(was, is, 100000, workers);
    EXPECT_GT(d.samples, 200000u);
    Kept kept;
    kept.before = union_area(was);
    kept.distance = std::max(d.forth, d.back) / diagonal_of(was);
    kept.area = (union_area(is).covered - kept.before.covered) / kept.before.covered;
    kept.move = repaired.report.largest_move / diagonal_of(was);
    return kept;
}

TEST(RepairedSurface, OfTrianglesAtRandomIsTheSame) {
    std::uint64_t overlaps = 0;
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
        // Of so few places that some overlap in a plane.
        const Kept kept = repair_and_compare(scene_of(grid_soup(40, 4, seed)), true);
        overlaps += kept.before.clusters;
        EXPECT_LT(kept.distance, 1e-15);
        EXPECT_NEAR(kept.area, 0.0, 1e-13);
    }
    EXPECT_GT(overlaps, 0u);
}

class RealDataRepair : public testing::TestWithParam<const char*> {};

TEST_P(RealDataRepair, KeepsTheSurface) {
    const std::filesystem::path data = TRANSILLUM_TEST_DATA;
    if (!std::filesystem::exists(data / "meshes")) GTEST_SKIP() << "no test data at " << data;
    Monitor silent;
    const Scene scene = load_scene(data / GetParam(), {}, silent);
    const Kept kept = repair_and_compare(scene, true);
    EXPECT_LT(kept.distance, 1e-6);
    EXPECT_LT(kept.distance, kept.move + 1e-15);
    if (kept.move == 0.0) {
        EXPECT_NEAR(kept.area, 0.0, 1e-9);
        return;
    }
    // What closes cracks moves vertices, so area: by the move along all edges that are moved, at
    // most along all there are. Without closing any, the area stays.
    const TriangleSoup soup = make_soup(scene);
    double edges = 0.0;
    for (const SoupTriangle& t : soup.triangles)
        for (int i = 0; i < 3; ++i)
            edges += glm::length(soup.positions[t.vertices[i]] -
                                 soup.positions[t.vertices[(i + 1) % 3]]);
    const double bound = kept.move * diagonal_of(soup) * edges / 2.0 / kept.before.covered;
    EXPECT_LT(std::abs(kept.area), bound);
    const Kept uncracked = repair_and_compare(scene, false);
    if (uncracked.move == 0.0) {
        EXPECT_NEAR(uncracked.area, 0.0, 1e-9);
    }
}

std::string name_of_file(const testing::TestParamInfo<const char*>& info) {
    std::string name = std::filesystem::path(info.param).stem().string();
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Files, RealDataRepair,
                         testing::Values("meshes/chair.off", "meshes/bathtub.obj",
                                         "meshes/truck.obj", "meshes/conrod.stl", "meshes/soup.stl",
                                         "meshes/two-boxes-bad-self-union.ply",
                                         "scenes/cornell-mcguire/CornellBox-Original.obj",
                                         "scenes/cornell-mcguire/CornellBox-Water.obj",
                                         "scenes/classroom-mgf/classroom-mgf.obj",
                                         "scenes/game-turbine/turbine.obj"),
                         name_of_file);

}  // namespace
}  // namespace transillum
