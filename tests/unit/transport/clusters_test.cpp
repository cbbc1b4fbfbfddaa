#include "transport/clusters.h"
#include "support/scene_builder.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

PatchHierarchy level_two(const SurfaceMesh& mesh) {
    return subdivide_to_levels(std::vector<int>(mesh.triangles.size(), 2));
}

TEST(Clusters, CoverEveryPatchAndTheEnvironment) {
    SceneBuilder b;
    b.sphere({0, 0, 0}, 1.0, 24, Facing::outwards);
    const SurfaceMesh mesh = b.surface();
    const PatchHierarchy patches = level_two(mesh);
    const Clusters clusters = make_clusters(mesh, patches);
    ASSERT_EQ(clusters.of_patch.size(), patches.patch_count() + 1);
    EXPECT_EQ(clusters.count, most_clusters);
    EXPECT_EQ(clusters.of_patch.back(), clusters.count);
    std::set<int> used(clusters.of_patch.begin(), clusters.of_patch.end() - 1);
    EXPECT_EQ(used.size(), clusters.count);
    EXPECT_EQ(*used.rbegin(), static_cast<int>(clusters.count) - 1);
}

TEST(Clusters, NeverJoinTheSidesOfAWallNorTwoRooms) {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    b.box({1.1, 0, 0}, {2.1, 1, 1}, Facing::inwards);
    const SurfaceMesh mesh = b.surface();
    const PatchHierarchy patches = level_two(mesh);
    const Clusters clusters = make_clusters(mesh, patches);
    std::map<int, std::set<std::pair<bool, bool>>> members;  // cluster -> (second room, back)
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p)
        members[clusters.of_patch[p]].insert(
            {patches.root_of_leaf[patches.leaf_of_patch(p)] >= 12, patches.is_back(p)});
    for (const auto& [cluster, kinds] : members)
        EXPECT_EQ(kinds.size(), 1u) << "cluster " << cluster;
}

TEST(Clusters, SetBlackBacksApart) {
    SceneBuilder b;
    b.sphere({0, 0, 0}, 1.0, 24, Facing::inwards);
    b.scene.materials[0].back_reflects = false;
    const SurfaceMesh mesh = b.surface();
    const PatchHierarchy patches = level_two(mesh);
    const Clusters clusters = make_clusters(mesh, patches);
    EXPECT_EQ(clusters.count, most_clusters);
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p)
        EXPECT_EQ(clusters.of_patch[p] == most_clusters - 1, patches.is_back(p)) << p;
}

TEST(Clusters, OfASingleTriangleAreItsSides) {
    SceneBuilder b;
    b.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const SurfaceMesh mesh = b.surface();
    EXPECT_EQ(make_clusters(mesh, level_two(mesh)).count, 2u);
}

}  // namespace
