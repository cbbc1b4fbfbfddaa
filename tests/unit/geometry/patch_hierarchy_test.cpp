#include "support/scene_builder.h"

#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/geometry/patch_hierarchy.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <limits>

namespace transillum {
namespace {

using testing_support::Facing;
using testing_support::SceneBuilder;

std::int64_t twice_area(const std::array<glm::ivec2, 3>& c) {
    const glm::ivec2 u = c[1] - c[0], v = c[2] - c[0];
    return std::int64_t{u.x} * v.y - std::int64_t{u.y} * v.x;
}

std::uint32_t look_up(int level, const glm::dvec2& b) {
    return leaf_in_root(level, static_cast<float>(b.x), static_cast<float>(b.y));
}

TEST(PatchHierarchy, LookUpIsTheInverseOfTheCorners) {
    Random random(4, 4);
    for (int level = 0; level <= 8; ++level) {
        const PatchHierarchy patches = subdivide_to_levels({level});
        const double n = 1 << level;
        std::int64_t area = 0;
        for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
            const auto c = leaf_corners(patches, leaf).b;
            ASSERT_EQ(twice_area(c), 1) << "level " << level << " leaf " << leaf;
            area += twice_area(c);
            ASSERT_EQ(look_up(level, glm::dvec2(c[0] + c[1] + c[2]) / (3.0 * n)), leaf)
                << "level " << level;
            // Further inside than float rounds: 2^-16 of the leaf at level 8.
            double u = random.next(), v = random.next();
            if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
            const glm::dvec2 local = (1.0 - 1e-4) * glm::dvec2(u, v) + glm::dvec2(1e-4 / 3.0);
            const glm::dvec2 point = glm::dvec2(c[0]) + local.x * glm::dvec2(c[1] - c[0]) +
                                     local.y * glm::dvec2(c[2] - c[0]);
            ASSERT_EQ(look_up(level, point / n), leaf) << "level " << level;
        }
        EXPECT_EQ(area, std::int64_t{1} << (2 * level));
    }
}

TEST(PatchHierarchy, LookUpHoldsAtTheDeepestLevel) {
    const PatchHierarchy patches = subdivide_to_levels({max_subdivision_level});
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
        const auto c = leaf_corners(patches, leaf).b;
        ASSERT_EQ(twice_area(c), 1);
        ASSERT_EQ(look_up(max_subdivision_level, glm::dvec2(c[0] + c[1] + c[2]) / (3.0 * 2048.0)),
                  leaf);
    }
}

/// Is a point within `slack` of the triangle, in barycentric units of the leaf?
bool contains(const std::array<glm::ivec2, 3>& c, const glm::dvec2& p, double slack) {
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 a(c[i]), edge = glm::dvec2(c[(i + 1) % 3]) - a;
        if (edge.x * (p.y - a.y) - edge.y * (p.x - a.x) < -slack) return false;
    }
    return true;
}

TEST(PatchHierarchy, PointsOnEdgesAndALittleOutsideGoToALeafTheyTouch) {
    Random random(8, 8);
    for (int level = 0; level <= max_subdivision_level; ++level) {
        const PatchHierarchy patches = subdivide_to_levels({level});
        const int n = 1 << level;
        for (int trial = 0; trial < 3000; ++trial) {
            // A grid point or a point of an outer edge, moved by up to the rounding of a float or
            // so.
            double b1 = std::floor(random.next() * (n + 1)) / n;
            double b2 = std::floor(random.next() * (n + 1)) / n;
            if (b1 + b2 > 1.0) b1 = 1.0 - b1, b2 = 1.0 - b2;
            if (trial % 4 == 1) b1 = 0.0, b2 = random.next();
            if (trial % 4 == 2) b2 = 0.0, b1 = random.next();
            if (trial % 4 == 3) b2 = 1.0 - b1;
            const double away = 1e-6 * (random.next() - 0.5), aside = 1e-6 * (random.next() - 0.5);
            const std::uint32_t leaf = look_up(level, {b1 + away, b2 + aside});
            ASSERT_LT(leaf, patches.leaf_count);
            EXPECT_TRUE(contains(leaf_corners(patches, leaf).b, glm::dvec2(b1, b2) * double(n),
                                 3e-6 * n + 1e-6))
                << "level " << level << ": " << b1 << ", " << b2;
        }
        // A last digit below a grid point: the sum of both may round up past it.
        for (int i = 1; i < n; i += 1 + n / 128)
            for (int j = 1; i + j < n; j += 1 + n / 128) {
                const float fn = static_cast<float>(n);
                const auto leaf =
                    leaf_in_root(level, std::nextafter(static_cast<float>(i) / fn, 0.0f),
                                 std::nextafter(static_cast<float>(j) / fn, 0.0f));
                ASSERT_LT(leaf, patches.leaf_count);
                ASSERT_TRUE(contains(leaf_corners(patches, leaf).b, {i, j}, 0.0)) << level;
            }
        const float huge = std::numeric_limits<float>::max();
        for (const float x : {-huge, -1.0f, 0.3f, 2.0f, huge})
            for (const float y : {-huge, -1.0f, 0.3f, 2.0f, huge})
                EXPECT_LT(leaf_in_root(level, x, y), patches.leaf_count);
    }
}

TEST(PatchHierarchy, NumbersLeavesRootByRoot) {
    const PatchHierarchy patches = subdivide_to_levels({2, 0, 3});
    EXPECT_EQ(patches.leaf_count, 16u + 1u + 64u);
    EXPECT_EQ(patches.patch_count(), 162u);
    EXPECT_EQ(patches.leaf_at(1, 0.3f, 0.3f), 16u);
    EXPECT_EQ(patches.leaf_at(2, 0.0f, 0.0f), 17u);
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf)
        EXPECT_EQ(patches.root_of_leaf[leaf], leaf < 16 ? 0u : leaf < 17 ? 1u : 2u);
    EXPECT_EQ(patches.leaf_of_patch(81 + 17), 17u);
    EXPECT_TRUE(patches.is_back(81));
    EXPECT_FALSE(patches.is_back(80));
}

TEST(PatchHierarchy, LeavesTileTheirRoot) {
    SceneBuilder builder;
    builder.sphere({0, 0, 0}, 1.0, 8, Facing::outwards);
    const SurfaceMesh mesh = builder.surface();
    const PatchHierarchy patches = subdivide_uniformly(mesh, {.patch_size = 0.1});
    std::vector<glm::dvec3> area(mesh.triangles.size());
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
        const std::uint32_t root = patches.root_of_leaf[leaf];
        const std::array<glm::dvec3, 3> p = points_of_leaf(mesh, patches, leaf);
        const glm::dvec3 piece = 0.5 * glm::cross(p[1] - p[0], p[2] - p[0]);
        EXPECT_NEAR(glm::length(piece) / area_of_leaf(mesh, patches, leaf), 1.0, 1e-9);
        area[root] += piece;
    }
    for (std::uint32_t root = 0; root < mesh.triangles.size(); ++root)
        EXPECT_NEAR(glm::distance(area[root], area_of(mesh, root) * normal_of(mesh, root)), 0.0,
                    1e-9);
}

double longest_edge(const SurfaceMesh& mesh, std::uint32_t root) {
    const auto& v = mesh.triangles[root].vertices;
    double longest = 0.0;
    for (int i = 0; i < 3; ++i)
        longest =
            std::max(longest, glm::distance(mesh.positions[v[i]], mesh.positions[v[(i + 1) % 3]]));
    return longest;
}

TEST(SubdivideUniformly, TakesTheFewestLevelsThatKeepThePatchSize) {
    SceneBuilder builder;
    builder.sphere({0, 0, 0}, 1.0, 10, Facing::outwards);
    builder.box({0, 0, 0}, {0.25, 4, 7}, Facing::outwards);
    const SurfaceMesh mesh = builder.surface();
    for (const double size : {10.0, 1.0, 0.37, 0.125}) {
        const PatchHierarchy patches = subdivide_uniformly(mesh, {.patch_size = size});
        for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r) {
            const int level = patches.roots[r].level;
            EXPECT_LE(std::ldexp(longest_edge(mesh, r), -level), size);
            if (level == 0) continue;
            EXPECT_GT(std::ldexp(longest_edge(mesh, r), 1 - level), size);
        }
    }
    for (const RootPatches& r :
         subdivide_uniformly(mesh, {.patch_size = 1e-9, .max_level = 3}).roots)
        EXPECT_EQ(r.level, 3);
}

TEST(SubdivideUniformly, ReachesTheNumberOfLeavesAskedFor) {
    SceneBuilder builder;
    builder.sphere({0, 0, 0}, 1.0, 20, Facing::outwards);
    const SurfaceMesh mesh = builder.surface();
    for (const std::uint32_t target : {500u, 5000u, 50000u}) {
        const PatchHierarchy patches = subdivide_uniformly(mesh, {.leaf_target = target});
        EXPECT_GE(patches.leaf_count, target);
        // All edges of one length take the step to four times as many at once.
        EXPECT_LE(patches.leaf_count, 4 * target);
    }
    EXPECT_EQ(subdivide_uniformly(mesh, {.leaf_target = 1000000000, .max_level = 1}).leaf_count,
              4 * mesh.triangles.size());
}

/// A wall beside slivers as of mouldings, each as long as the wall.
TEST(SubdivideUniformly, LeavesItsLeavesToWhatHasArea) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    for (int i = 0; i < 200; ++i)
        builder.polygon({{0, 0, 1.0 + i}, {1, 0, 1.0 + i}, {0, 1e-4, 1.0 + i}});
    const SurfaceMesh mesh = builder.surface();
    const PatchHierarchy patches = subdivide_uniformly(mesh, {.leaf_target = 1500});
    EXPECT_GE(patches.leaves_of(0), 1024u);
    EXPECT_GT(patches.leaves_of(1), 1u) << "light may change along a sliver, too";
    EXPECT_LE(patches.leaves_of(1), 4u);
}

TEST(SubdivideUniformly, DividesByDefaultWhatIsLargeAmongManyTriangles) {
    SceneBuilder builder;
    builder.sphere({0, 0, 0}, 0.1, 300, Facing::outwards);
    builder.box({-1, -1, -1}, {1, 1, 1}, Facing::inwards);
    const SurfaceMesh mesh = builder.surface();
    const auto triangles = static_cast<std::uint32_t>(mesh.triangles.size());
    ASSERT_GT(triangles, 60000u);
    const PatchHierarchy patches = subdivide_uniformly(mesh, {});
    EXPECT_GE(patches.leaf_count, 2 * triangles);
    EXPECT_EQ(patches.leaves_of(0), 1u) << "of the sphere";
    EXPECT_GE(patches.leaves_of(triangles - 1), 4096u) << "of a wall";
}

TEST(SubdivideUniformly, LeavesAFineMeshAsItIs) {
    SceneBuilder builder;
    builder.sphere({0, 0, 0}, 1.0, 800, Facing::outwards);
    const SurfaceMesh mesh = builder.surface();
    ASSERT_GT(mesh.triangles.size(), 400000u);
    EXPECT_LT(subdivide_uniformly(mesh, {}).leaf_count, mesh.triangles.size() + 30000);
}

TEST(SubdivideUniformly, RefusesWhatItCannotDo) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {1, 1, 1}, Facing::outwards);
    const SurfaceMesh mesh = builder.surface();
    const auto with = [&](double size, int level) {
        (void)subdivide_uniformly(mesh, {.patch_size = size, .max_level = level});
    };
    EXPECT_THROW(with(-0.1, 3), UsageError);
    EXPECT_THROW(with(std::numeric_limits<double>::quiet_NaN(), 3), UsageError);
    EXPECT_THROW(with(std::numeric_limits<double>::infinity(), 3), UsageError);
    EXPECT_THROW(with(0.1, -1), UsageError);
    EXPECT_THROW(with(0.1, max_subdivision_level + 1), UsageError);
    EXPECT_NO_THROW(with(0.1, max_subdivision_level));
    EXPECT_THROW((void)subdivide_to_levels({0, 12}), UsageError);
    EXPECT_THROW((void)subdivide_to_levels({-1}), UsageError);
    EXPECT_THROW((void)subdivide_to_levels(std::vector<int>(257, 11)), UsageError);
}

}  // namespace
}  // namespace transillum
