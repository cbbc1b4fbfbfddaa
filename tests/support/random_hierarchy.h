/// Hierarchies whose roots have leaves of several levels.
#pragma once

#include <transillum/base/sampling.h>
#include <transillum/geometry/split_leaves.h>

#include <cstdint>
#include <vector>

namespace transillum::testing_support {

/// Rounds after which each leaf has split with a chance of a third.
inline PatchHierarchy random_hierarchy(const std::vector<int>& levels, int rounds,
                                       std::uint64_t seed) {
    Random random(seed, 77);
    PatchHierarchy patches = subdivide_to_levels(levels);
    for (int round = 0; round < rounds; ++round) {
        std::vector<std::uint8_t> split(patches.leaf_count);
        for (std::uint8_t& s : split) s = random.next() < 1.0 / 3.0 ? 1 : 0;
        patches = split_leaves(patches, split).patches;
    }
    return patches;
}

}  // namespace transillum::testing_support
