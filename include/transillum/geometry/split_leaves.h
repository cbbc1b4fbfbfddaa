/// Refinement of a hierarchy: leaves split 1-to-4 at their midpoints (paper §3.2).
#pragma once

#include <transillum/geometry/patch_hierarchy.h>

#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

struct SplitPatches {
    PatchHierarchy patches;
    std::vector<std::uint32_t> parent;  ///< of every new leaf, the old one it is or is a quarter of
};

/// \param split one a leaf: other than 0 where it splits.
/// \throws UsageError when a leaf is at max_subdivision_level already; above 2^30 leaves or 2^30
/// entries of the tables of mixed roots; or unless there is one entry a leaf.
[[nodiscard]] SplitPatches split_leaves(const PatchHierarchy& patches,
                                        std::span<const std::uint8_t> split);

/// Every leaf into four.
[[nodiscard]] SplitPatches split_all_leaves(const PatchHierarchy& patches);

}  // namespace transillum
