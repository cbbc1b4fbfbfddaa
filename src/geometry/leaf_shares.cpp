#include <transillum/base/error.h>
#include <transillum/geometry/leaf_shares.h>

#include <cmath>
#include <string>

namespace transillum {

namespace {

using Corners = std::array<glm::ivec2, 3>;  ///< in units of 2^-level of the root

/// At the corners, and in the middle.
std::array<Corners, 4> quarters_of(const Corners& c) {
    const glm::ivec2 ab = c[0] + c[1], bc = c[1] + c[2], ca = c[2] + c[0];
    return {Corners{2 * c[0], ab, ca}, Corners{ab, 2 * c[1], bc}, Corners{ca, bc, 2 * c[2]},
            Corners{bc, ca, ab}};
}

void add_shares(const PatchHierarchy& earlier, std::uint32_t root, const Corners& corners,
                int level, std::vector<LeafShare>& shares) {
    const glm::vec2 middle =
        std::ldexp(1.0f / 3.0f, -level) * glm::vec2(corners[0] + corners[1] + corners[2]);
    const std::uint32_t leaf = earlier.leaf_at(root, middle.x, middle.y);
    const int deeper = level - earlier.level_of_leaf(leaf);
    if (deeper >= 0) {
        shares.push_back({leaf, std::ldexp(1.0f, -2 * deeper)});
        return;
    }
    for (const Corners& quarter : quarters_of(corners))
        add_shares(earlier, root, quarter, level + 1, shares);
}

}  // namespace

LeafShares leaf_shares(const PatchHierarchy& earlier, const PatchHierarchy& patches) {
    if (earlier.roots.size() != patches.roots.size())
        throw UsageError("hierarchies of " + std::to_string(earlier.roots.size()) + " and " +
                         std::to_string(patches.roots.size()) + " roots; accepted: the same roots");
    LeafShares all;
    all.first.push_back(0);
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
        const LeafCorners corners = leaf_corners(patches, leaf);
        add_shares(earlier, patches.root_of_leaf[leaf], corners.b, corners.level, all.shares);
        all.first.push_back(static_cast<std::uint32_t>(all.shares.size()));
    }
    return all;
}

}  // namespace transillum
