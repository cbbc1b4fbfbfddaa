/// Trees of leaves that differ in level, against an oracle that splits triangles by hand.
#include "support/random_hierarchy.h"

#include <transillum/base/error.h>
#include <transillum/geometry/root_trees.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace transillum {
namespace {

using testing_support::random_hierarchy;

/// Corners as fractions of the root, which midpoints leave exact.
using Triangle = std::array<glm::dvec2, 3>;

constexpr Triangle whole{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)};

std::array<Triangle, 4> quarters(const Triangle& t) {
    const glm::dvec2 a = t[0], b = t[1], c = t[2];
    const glm::dvec2 ab = (a + b) / 2.0, bc = (b + c) / 2.0, ca = (c + a) / 2.0;
    Triangle middle{ab, bc, ca};
    std::ranges::rotate(middle, std::ranges::min_element(middle, {}, [](const glm::dvec2& p) {
                            return std::pair(p.y, p.x);
                        }));
    return {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, middle};
}

struct Leaf {
    Triangle corners;
    int level;
};

/// Reads levels in preorder.
void read_tree(const Triangle& t, int level, const std::uint8_t*& next, std::vector<Leaf>& leaves) {
    if (*next == level) {
        leaves.push_back({t, level});
        ++next;
    } else {
        for (const Triangle& quarter : quarters(t)) read_tree(quarter, level + 1, next, leaves);
    }
}

Triangle fractions_of(const LeafCorners& c) {
    Triangle t;
    for (int i = 0; i < 3; ++i) t[i] = glm::dvec2(c.b[i]) / double(1 << c.level);
    return t;
}

double twice_area(const Triangle& t) {
    const glm::dvec2 u = t[1] - t[0], v = t[2] - t[0];
    return u.x * v.y - u.y * v.x;
}

std::uint32_t look_up(const PatchHierarchy& patches, std::uint32_t root, const glm::dvec2& b) {
    return patches.leaf_at(root, static_cast<float>(b.x), static_cast<float>(b.y));
}

glm::dvec2 point_within(const Triangle& t, Random& random) {
    double u = random.next(), v = random.next();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    u = 0.998 * u + 0.001;
    v = 0.998 * v + 0.001 / 3.0;
    return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

bool contains(const Triangle& t, const glm::dvec2& p) {
    for (int i = 0; i < 3; ++i)
        if (twice_area({t[i], t[(i + 1) % 3], p}) < 0.0) return false;
    return true;
}

using Levels = std::vector<std::uint8_t>;

/// Levels in preorder of every tree of at most so many levels below `level`.
std::vector<Levels> all_trees(std::uint8_t level, int below) {
    std::vector<Levels> trees{{level}};
    if (below == 0) return trees;
    const auto children = all_trees(static_cast<std::uint8_t>(level + 1), below - 1);
    std::vector<Levels> forests{{}};
    for (int child = 0; child < 4; ++child) {
        std::vector<Levels> longer;
        for (const Levels& forest : forests)
            for (const Levels& tree : children) {
                longer.push_back(forest);
                longer.back().insert(longer.back().end(), tree.begin(), tree.end());
            }
        forests = std::move(longer);
    }
    trees.insert(trees.end(), forests.begin(), forests.end());
    return trees;
}

/// One root with that tree.
RootTrees tree_of(const Levels& levels) {
    const auto [least, most] = std::ranges::minmax(levels);
    return {{most}, {static_cast<std::uint32_t>(levels.size())}, least == most ? Levels{} : levels};
}

TEST(MixedRoots, EveryTreeOfThreeLevelsIsWhatSplittingMakesOfIt) {
    const auto trees = all_trees(0, 3);
    ASSERT_EQ(trees.size(), 1u + 17u * 17u * 17u * 17u);
    Random random(3, 1);
    SurfaceMesh mesh;
    mesh.positions = {{1, 0, 2}, {5, 0, 2}, {1, 2, 2}};
    mesh.triangles = {{.vertices = {0, 1, 2}}};
    for (const Levels& levels : trees) {
        std::vector<Leaf> expected;
        const std::uint8_t* next = levels.data();
        read_tree(whole, 0, next, expected);
        const PatchHierarchy patches = subdivide_to_trees(tree_of(levels));
        ASSERT_EQ(patches.leaf_count, expected.size());
        const bool uniform = patches.roots[0].mixed == RootPatches::uniform;
        ASSERT_EQ(uniform, patches.mixed_roots.empty());
        ASSERT_EQ(uniform, std::ranges::adjacent_find(levels, std::not_equal_to{}) == levels.end());
        double area = 0.0;
        for (std::uint32_t k = 0; k < expected.size(); ++k) {
            const auto& [corners, level] = expected[k];
            const auto leaf = look_up(patches, 0, (corners[0] + corners[1] + corners[2]) / 3.0);
            if (!uniform) {
                ASSERT_EQ(leaf, k);
            }
            ASSERT_EQ(look_up(patches, 0, point_within(corners, random)), leaf);
            ASSERT_TRUE(fractions_of(leaf_corners(patches, leaf)) == corners);
            ASSERT_EQ(leaf_corners(patches, leaf).level, level);
            ASSERT_EQ(patches.level_of_leaf(leaf), level);
            ASSERT_EQ(patches.root_of_leaf[leaf], 0u);
            area += area_of_leaf(mesh, patches, leaf);
        }
        ASSERT_EQ(area, 4.0);
        const RootTrees again = trees_of(patches);
        ASSERT_EQ(again.levels, tree_of(levels).levels);
        ASSERT_EQ(again.leaf_counts, tree_of(levels).leaf_counts);
        ASSERT_EQ(again.leaf_levels, tree_of(levels).leaf_levels);
    }
}

TEST(MixedRoots, LookUpFindsLeavesDownToTheDeepestLevel) {
    Random random(5, 5);
    PatchHierarchy patches = subdivide_to_levels({0, 1});
    for (int level = 0; level < max_subdivision_level; ++level) {
        std::vector<std::uint8_t> split(patches.leaf_count);
        for (const std::uint32_t root : {0u, 1u})
            split[look_up(patches, root, {0.37, 0.41})] = level + root < max_subdivision_level;
        patches = split_leaves(patches, split).patches;
    }
    EXPECT_EQ(patches.roots[0].level, max_subdivision_level);
    EXPECT_EQ(patches.roots[1].level, max_subdivision_level);
    EXPECT_EQ(patches.leaf_count, 1u + 3u * 11u + 4u + 3u * 10u);
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
        const Triangle t = fractions_of(leaf_corners(patches, leaf));
        const std::uint32_t root = patches.root_of_leaf[leaf];
        EXPECT_EQ(look_up(patches, root, (t[0] + t[1] + t[2]) / 3.0), leaf);
        // Floats round by 2^-13 of the deepest leaf.
        for (int i = 0; i < 20; ++i)
            EXPECT_EQ(look_up(patches, root, point_within(t, random)), leaf);
    }
    std::vector<std::uint8_t> deeper(patches.leaf_count);
    deeper[look_up(patches, 1, {0.37, 0.41})] = 1;
    EXPECT_THROW((void)split_leaves(patches, deeper), UsageError);
    EXPECT_THROW((void)split_all_leaves(patches), UsageError);
}

TEST(SplitLeaves, PartsLieInTheirParents) {
    Random random(6, 6);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const PatchHierarchy old =
            random_hierarchy({0, 2, 1, 0, 3}, static_cast<int>(seed % 4), seed);
        std::vector<std::uint8_t> split(old.leaf_count);
        std::uint32_t splits = 0;
        for (std::uint8_t& s : split) splits += s = random.next() < 0.3;
        const SplitPatches made = split_leaves(old, split);
        ASSERT_EQ(made.patches.leaf_count, old.leaf_count + 3 * splits);
        ASSERT_EQ(made.parent.size(), made.patches.leaf_count);
        std::vector<int> parts(old.leaf_count);
        for (std::uint32_t leaf = 0; leaf < made.patches.leaf_count; ++leaf) {
            const std::uint32_t parent = made.parent[leaf];
            ++parts[parent];
            EXPECT_EQ(made.patches.root_of_leaf[leaf], old.root_of_leaf[parent]);
            EXPECT_EQ(made.patches.level_of_leaf(leaf), old.level_of_leaf(parent) + split[parent]);
            const Triangle outer = fractions_of(leaf_corners(old, parent));
            const Triangle inner = fractions_of(leaf_corners(made.patches, leaf));
            for (const glm::dvec2& corner : inner) EXPECT_TRUE(contains(outer, corner));
            const glm::dvec2 point = point_within(inner, random);
            EXPECT_EQ(look_up(made.patches, old.root_of_leaf[parent], point), leaf);
            EXPECT_EQ(look_up(old, old.root_of_leaf[parent], point), parent);
        }
        for (std::uint32_t leaf = 0; leaf < old.leaf_count; ++leaf)
            EXPECT_EQ(parts[leaf], split[leaf] ? 4 : 1);
    }
}

TEST(SplitLeaves, RootsOfOneLevelAreUniform) {
    const PatchHierarchy start = subdivide_to_levels({0, 2, 1});
    EXPECT_TRUE(split_all_leaves(start).patches == subdivide_to_levels({1, 3, 2}));
    // All but one leaf, then that one.
    std::vector<std::uint8_t> most(start.leaf_count, 1);
    most[5] = 0;
    const PatchHierarchy mixed = split_leaves(start, most).patches;
    EXPECT_EQ(mixed.mixed_roots.size(), 1u);
    EXPECT_NE(mixed.roots[1].mixed, RootPatches::uniform);
    std::vector<std::uint8_t> last(mixed.leaf_count);
    for (std::uint32_t leaf = 0; leaf < mixed.leaf_count; ++leaf)
        last[leaf] = mixed.root_of_leaf[leaf] == 1 && mixed.level_of_leaf(leaf) == 2;
    EXPECT_EQ(std::ranges::count(last, 1), 1);
    EXPECT_TRUE(split_leaves(mixed, last).patches == subdivide_to_levels({1, 3, 2}));
}

TEST(SplitLeaves, NothingToSplitChangesNothing) {
    const PatchHierarchy patches = random_hierarchy({0, 2, 1}, 3, 9);
    ASSERT_FALSE(patches.mixed_roots.empty());
    const SplitPatches same = split_leaves(patches, std::vector<std::uint8_t>(patches.leaf_count));
    EXPECT_TRUE(same.patches == patches);
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf)
        EXPECT_EQ(same.parent[leaf], leaf);
}

TEST(SplitLeaves, RefusesWhatItCannotDo) {
    const PatchHierarchy patches = subdivide_to_levels({2, max_subdivision_level});
    EXPECT_THROW((void)split_leaves(patches, std::vector<std::uint8_t>(16)), UsageError);
    EXPECT_THROW((void)split_all_leaves(patches), UsageError);
    std::vector<std::uint8_t> split(patches.leaf_count);
    split[3] = 1;
    EXPECT_NO_THROW((void)split_leaves(patches, split));
}

TEST(RootTrees, AreTheInverseOfSubdividingToThem) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const PatchHierarchy patches =
            random_hierarchy({1, 0, 2, 0, 0}, static_cast<int>(seed % 5), seed);
        EXPECT_TRUE(subdivide_to_trees(trees_of(patches)) == patches);
    }
    EXPECT_TRUE(trees_of(subdivide_to_levels({3, 0, 5})).leaf_levels.empty());
}

TEST(RootTrees, RefuseWhatIsNoTree) {
    const Levels tree{1, 1, 2, 2, 2, 2, 1};
    const auto made = [](std::int32_t level, std::uint32_t count, const Levels& levels) {
        return subdivide_to_trees({{level}, {count}, levels}).leaf_count;
    };
    EXPECT_EQ(made(2, 7, tree), 7u);
    EXPECT_THROW((void)made(-1, 7, tree), UsageError);
    EXPECT_THROW((void)made(12, 7, tree), UsageError);
    EXPECT_THROW((void)made(3, 7, tree), UsageError);  // none so deep
    EXPECT_THROW((void)made(1, 7, tree), UsageError);  // some too deep
    EXPECT_THROW((void)made(2, 6, tree), UsageError);
    EXPECT_THROW((void)made(2, 8, tree), UsageError);
    EXPECT_THROW((void)made(2, 0, {}), UsageError);
    EXPECT_THROW((void)made(2, 0xffffffffu, tree), UsageError);
    EXPECT_THROW((void)made(2, 16, tree), UsageError);  // uniform, and levels left over
    EXPECT_THROW((void)made(2, 7, {1, 1, 2, 2, 2, 1, 1}), UsageError);
    EXPECT_THROW((void)made(2, 7, {1, 1, 2, 2, 2, 2, 0}), UsageError);
    EXPECT_THROW((void)made(2, 7, {2, 2, 2, 2, 1, 1, 2}), UsageError);
    EXPECT_THROW((void)subdivide_to_trees({{0, 0}, {1}, {}}), UsageError);
    // Any level changed makes another tree or none.
    for (std::size_t k = 0; k < tree.size(); ++k)
        for (std::uint8_t level = 0; level < 16; ++level) {
            Levels other = tree;
            other[k] = level;
            if (other != tree) {
                EXPECT_THROW((void)made(2, 7, other), UsageError);
            }
        }
    // One leaf at the deepest level takes a table of 4^11 entries: 257 such roots are too many.
    Levels deep;
    for (std::uint8_t level = 1; level < max_subdivision_level; ++level)
        deep.insert(deep.end(), 3, level);
    std::ranges::reverse(deep);
    deep.insert(deep.begin(), 4, max_subdivision_level);
    EXPECT_EQ(made(max_subdivision_level, 34, deep), 34u);
    RootTrees many{std::vector<std::int32_t>(257, max_subdivision_level),
                   std::vector<std::uint32_t>(257, 34),
                   {}};
    for (int root = 0; root < 257; ++root)
        many.leaf_levels.insert(many.leaf_levels.end(), deep.begin(), deep.end());
    EXPECT_THROW((void)subdivide_to_trees(many), UsageError);
}

}  // namespace
}  // namespace transillum
