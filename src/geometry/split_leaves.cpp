#include <transillum/base/error.h>
#include <transillum/geometry/split_leaves.h>

#include "geometry/hierarchy_builder.h"

#include <algorithm>
#include <string>

namespace transillum {

namespace {

/// Triangles in preorder, each with the old leaf it comes from.
struct Pieces {
    std::vector<LeafTriangle> triangles;
    std::vector<std::uint32_t> parents;

    void add(const LeafTriangle& triangle, std::uint32_t parent) {
        triangles.push_back(triangle);
        parents.push_back(parent);
    }
};

class Splitter {
public:
    Splitter(const PatchHierarchy& patches, std::span<const std::uint8_t> split)
        : patches_(patches), split_(split) {}

    /// Table entries that the root will need.
    [[nodiscard]] std::uint64_t cells(std::uint32_t root) const {
        const std::uint32_t first = patches_.roots[root].first_leaf;
        int highest = max_subdivision_level + 1, deepest = 0;
        for (std::uint32_t leaf = first; leaf < first + patches_.leaves_of(root); ++leaf) {
            const int level = patches_.level_of_leaf(leaf) + (split_[leaf] != 0 ? 1 : 0);
            highest = std::min(highest, level);
            deepest = std::max(deepest, level);
        }
        return highest < deepest ? cells_of(deepest) : 0;
    }

    [[nodiscard]] Pieces pieces_of(std::uint32_t root) const {
        const RootPatches& r = patches_.roots[root];
        Pieces pieces;
        if (r.mixed == RootPatches::uniform)
            descend({}, r, pieces);
        else
            for (std::uint32_t k = 0; k < patches_.leaves_of(root); ++k)
                add_leaf(patches_.mixed_roots[r.mixed].leaves[k], r.first_leaf + k, pieces);
        return pieces;
    }

private:
    /// The leaves of a uniform root in preorder.
    void descend(const LeafTriangle& triangle, const RootPatches& r, Pieces& pieces) const {
        if (triangle.level == r.level)
            add_leaf(triangle, r.first_leaf + number_of(triangle), pieces);
        else
            for (const LeafTriangle& child : children_of(triangle)) descend(child, r, pieces);
    }

    void add_leaf(const LeafTriangle& triangle, std::uint32_t leaf, Pieces& pieces) const {
        if (split_[leaf] == 0) return pieces.add(triangle, leaf);
        if (triangle.level >= max_subdivision_level)
            throw UsageError("leaf " + std::to_string(leaf) + " is at level " +
                             std::to_string(max_subdivision_level) +
                             " and cannot be split; accepted: leaves of smaller levels");
        for (const LeafTriangle& child : children_of(triangle)) pieces.add(child, leaf);
    }

    const PatchHierarchy& patches_;
    std::span<const std::uint8_t> split_;
};

}  // namespace

SplitPatches split_leaves(const PatchHierarchy& patches, std::span<const std::uint8_t> split) {
    if (split.size() != patches.leaf_count)
        throw UsageError(std::to_string(split.size()) +
                         " leaves to split or not; accepted: one entry for each of " +
                         std::to_string(patches.leaf_count));
    const auto splits = static_cast<std::uint64_t>(
        std::ranges::count_if(split, [](std::uint8_t s) { return s != 0; }));
    const std::uint64_t leaves = patches.leaf_count + 3 * splits;
    const Splitter splitter(patches, split);
    std::uint64_t cells = 0;
    for (std::uint32_t root = 0; root < patches.roots.size(); ++root) cells += splitter.cells(root);
    HierarchyBuilder builder(patches.roots.size(), leaves, cells);
    std::vector<std::uint32_t> parent(leaves);
    for (std::uint32_t root = 0; root < patches.roots.size(); ++root) {
        const Pieces pieces = splitter.pieces_of(root);
        builder.add(pieces.triangles);
        const RootPatches& made = builder.last();
        for (std::uint32_t k = 0; k < pieces.triangles.size(); ++k) {
            const std::uint32_t place =
                made.mixed == RootPatches::uniform ? number_of(pieces.triangles[k]) : k;
            parent[made.first_leaf + place] = pieces.parents[k];
        }
    }
    return {builder.take(), std::move(parent)};
}

SplitPatches split_all_leaves(const PatchHierarchy& patches) {
    return split_leaves(patches, std::vector<std::uint8_t>(patches.leaf_count, 1));
}

}  // namespace transillum
