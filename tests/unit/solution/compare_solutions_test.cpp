#include "random_solution.h"

#include "support/random_hierarchy.h"

#include <transillum/base/error.h>
#include <transillum/solution/compare_solutions.h>

#include <gtest/gtest.h>

#include <cmath>

namespace transillum::test {

TEST(CompareSolutions, OfLeavesOfSeveralLevelsAreWeightedByTheirAreas) {
    Solution a = random_solution({.levels = {0, 1}, .splits = 3, .light_samples = 0}, 1);
    ASSERT_FALSE(a.patches.mixed_roots.empty());
    a.coverage.assign(a.coverage.size(), 1.0f);
    a.direct_irradiance.assign(a.coverage.size(), Spectrum(1.0f));
    a.indirect_irradiance.assign(a.coverage.size(), Spectrum(1.0f));
    EXPECT_EQ(compare_solutions(a, a).relative_rmse, 0.0);
    // Leaves of the first root alone, one side, are brighter: by their share of the area.
    Solution b = a;
    double area = 0.0, brighter = 0.0;
    for (std::uint32_t leaf = 0; leaf < a.patches.leaf_count; ++leaf) {
        const double share = area_of_leaf(a.surface, a.patches, leaf);
        area += 2.0 * share;
        if (a.patches.root_of_leaf[leaf] != 0) continue;
        a.direct_irradiance[leaf] = Spectrum(2.0f);
        brighter += share;
    }
    EXPECT_NEAR(brighter, area_of(a.surface, 0), 1e-12);
    const SolutionDifference d = compare_solutions(a, b);
    EXPECT_EQ(d.patches, a.patches.patch_count());
    EXPECT_NEAR(d.bias, 0.5 * brighter / area, 1e-6);
    EXPECT_NEAR(d.relative_rmse, 0.5 * std::sqrt(brighter / area), 1e-6);
}

TEST(CompareSolutions, RefusesOtherTreesOfAsManyLeaves) {
    Solution a = random_solution({.levels = {1, 0}, .light_samples = 0}, 1);
    Solution b = a;
    std::vector<std::uint8_t> first(5), second(5);
    first[0] = second[1] = 1;
    a.patches = split_leaves(a.patches, first).patches;
    b.patches = split_leaves(b.patches, second).patches;
    ASSERT_EQ(a.patches.leaf_count, b.patches.leaf_count);
    EXPECT_THROW((void)compare_solutions(a, b), InputError);
}

}  // namespace transillum::test
