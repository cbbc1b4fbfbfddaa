/// A hierarchy in few numbers, for files: equal hierarchies give equal numbers.
#pragma once

#include <transillum/geometry/patch_hierarchy.h>

#include <cstdint>
#include <vector>

namespace transillum {

struct RootTrees {
    std::vector<std::int32_t> levels;        ///< one a root: of its smallest leaves
    std::vector<std::uint32_t> leaf_counts;  ///< one a root; 4^level where all are of that level
    /// Of every other root, root by root, the levels of its leaves in preorder, which determine its
    /// tree.
    std::vector<std::uint8_t> leaf_levels;
};

[[nodiscard]] RootTrees trees_of(const PatchHierarchy& patches);

/// The inverse. \throws UsageError that names the root when the numbers belong to no hierarchy, or
/// to one that split_leaves would refuse to make.
[[nodiscard]] PatchHierarchy subdivide_to_trees(const RootTrees& trees);

}  // namespace transillum
