#include <transillum/base/error.h>
#include <transillum/geometry/leaf_shares.h>

#include "support/random_hierarchy.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

TEST(LeafShares, OfTheSameHierarchyAreTheLeavesThemselves) {
    const PatchHierarchy patches = random_hierarchy({0, 2, 1}, 3, 5);
    const LeafShares shares = leaf_shares(patches, patches);
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
        ASSERT_EQ(shares.of(leaf).size(), 1u);
        EXPECT_EQ(shares.of(leaf)[0].leaf, leaf);
        EXPECT_EQ(shares.of(leaf)[0].share, 1.0f);
    }
}

TEST(LeafShares, OfChildrenAreQuartersOfTheirParents) {
    const PatchHierarchy patches = random_hierarchy({0, 3, 1}, 2, 6);
    const SplitPatches children = split_all_leaves(patches);
    const LeafShares down = leaf_shares(patches, children.patches);
    for (std::uint32_t child = 0; child < children.patches.leaf_count; ++child) {
        ASSERT_EQ(down.of(child).size(), 1u);
        EXPECT_EQ(down.of(child)[0].leaf, children.parent[child]);
        EXPECT_EQ(down.of(child)[0].share, 0.25f);
    }
    const LeafShares up = leaf_shares(children.patches, patches);
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
        ASSERT_EQ(up.of(leaf).size(), 4u);
        for (const LeafShare& s : up.of(leaf)) {
            EXPECT_EQ(children.parent[s.leaf], leaf);
            EXPECT_EQ(s.share, 1.0f);
        }
    }
}

// Between any two hierarchies nothing is lost or counted twice, and areas agree.
TEST(LeafShares, CoverEveryEarlierLeafOnce) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const PatchHierarchy a = random_hierarchy({0, 2, 1, 3}, 3, seed);
        const PatchHierarchy b = random_hierarchy({0, 1, 3, 2}, 3, seed + 100);
        const LeafShares shares = leaf_shares(a, b);
        std::vector<double> taken(a.leaf_count);
        for (std::uint32_t leaf = 0; leaf < b.leaf_count; ++leaf) {
            double area = 0.0;
            for (const LeafShare& s : shares.of(leaf)) {
                EXPECT_EQ(a.root_of_leaf[s.leaf], b.root_of_leaf[leaf]);
                taken[s.leaf] += s.share;
                area += s.share * std::ldexp(1.0, -2 * a.level_of_leaf(s.leaf));
            }
            EXPECT_EQ(area, std::ldexp(1.0, -2 * b.level_of_leaf(leaf)));
        }
        for (const double t : taken) EXPECT_EQ(t, 1.0);
    }
}

TEST(LeafShares, NeedTheSameRoots) {
    EXPECT_THROW(
        static_cast<void>(leaf_shares(subdivide_to_levels({0}), subdivide_to_levels({0, 1}))),
        UsageError);
}

}  // namespace
