#include <transillum/base/error.h>
#include <transillum/geometry/root_trees.h>

#include "geometry/hierarchy_builder.h"

#include <algorithm>
#include <span>
#include <string>

namespace transillum {

namespace {

/// Reads the levels of a root's leaves in preorder.
class TreeReader {
public:
    TreeReader(std::uint32_t root, std::span<const std::uint8_t> levels)
        : root_(root), levels_(levels) {}

    [[nodiscard]] std::vector<LeafTriangle> read(int deepest) {
        descend({}, deepest);
        if (leaves_.size() != levels_.size()) refuse("has fewer");
        const auto has_level = [&](const LeafTriangle& t) { return t.level == deepest; };
        if (std::ranges::none_of(leaves_, has_level))
            refuse("has none of level " + std::to_string(deepest));
        return std::move(leaves_);
    }

private:
    void descend(const LeafTriangle& triangle, int deepest) {
        if (leaves_.size() == levels_.size()) refuse("has more");
        const int level = levels_[leaves_.size()];
        if (level < triangle.level || level > deepest)
            refuse("cannot have one of level " + std::to_string(level) + " as number " +
                   std::to_string(leaves_.size()));
        if (level == triangle.level)
            leaves_.push_back(triangle);
        else
            for (const LeafTriangle& child : children_of(triangle)) descend(child, deepest);
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw UsageError("root " + std::to_string(root_) + " of " + std::to_string(levels_.size()) +
                         " leaves: a tree of their levels " + why);
    }

    std::uint32_t root_;
    std::span<const std::uint8_t> levels_;
    std::vector<LeafTriangle> leaves_;
};

bool is_uniform(const RootTrees& trees, std::size_t root) {
    return trees.leaf_counts[root] == cells_of(trees.levels[root]);
}

}  // namespace

RootTrees trees_of(const PatchHierarchy& patches) {
    RootTrees trees;
    for (std::uint32_t root = 0; root < patches.roots.size(); ++root) {
        const RootPatches& r = patches.roots[root];
        trees.levels.push_back(r.level);
        trees.leaf_counts.push_back(patches.leaves_of(root));
        if (r.mixed == RootPatches::uniform) continue;
        for (const LeafTriangle& leaf : patches.mixed_roots[r.mixed].leaves)
            trees.leaf_levels.push_back(leaf.level);
    }
    return trees;
}

PatchHierarchy subdivide_to_trees(const RootTrees& trees) {
    if (trees.leaf_counts.size() != trees.levels.size())
        throw UsageError(std::to_string(trees.leaf_counts.size()) + " numbers of leaves for " +
                         std::to_string(trees.levels.size()) + " roots");
    std::uint64_t leaves = 0, cells = 0;
    for (std::size_t root = 0; root < trees.levels.size(); ++root) {
        require_level(trees.levels[root]);
        leaves += trees.leaf_counts[root];
        if (!is_uniform(trees, root)) cells += cells_of(trees.levels[root]);
    }
    HierarchyBuilder builder(trees.levels.size(), leaves, cells);
    std::span<const std::uint8_t> left(trees.leaf_levels);
    for (std::uint32_t root = 0; root < trees.levels.size(); ++root) {
        const std::uint32_t count = trees.leaf_counts[root];
        if (is_uniform(trees, root)) {
            builder.add_uniform(trees.levels[root]);
            continue;
        }
        if (count > left.size())
            throw UsageError("root " + std::to_string(root) + " of " + std::to_string(count) +
                             " leaves: there are levels for " + std::to_string(left.size()));
        builder.add(TreeReader(root, left.first(count)).read(trees.levels[root]));
        left = left.subspan(count);
    }
    if (!left.empty())
        throw UsageError("levels of " + std::to_string(left.size()) +
                         " leaves more than there are");
    return builder.take();
}

}  // namespace transillum
