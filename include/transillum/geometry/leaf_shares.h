/// Carrying over what is known of the leaves of one hierarchy to another of the same roots.
#pragma once

#include <transillum/geometry/patch_hierarchy.h>

#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

struct LeafShare {
    std::uint32_t leaf = 0;  ///< of the earlier hierarchy
    float share = 1.0f;      ///< of its area
};

/// What the leaves of a hierarchy are made of: each is one of the earlier leaves, a part of one, or
/// a union of several.
struct LeafShares {
    std::vector<LeafShare> shares;
    std::vector<std::uint32_t> first;  ///< leaf l has shares [first[l], first[l + 1])
    [[nodiscard]] std::span<const LeafShare> of(std::uint32_t leaf) const {
        return std::span(shares).subspan(first[leaf], first[leaf + 1] - first[leaf]);
    }
};

/// \throws UsageError unless both have as many roots.
[[nodiscard]] LeafShares leaf_shares(const PatchHierarchy& earlier, const PatchHierarchy& patches);

}  // namespace transillum
