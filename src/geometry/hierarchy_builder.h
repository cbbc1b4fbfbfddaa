/// Puts a hierarchy together root by root, from the triangles of its leaves.
#pragma once

#include <transillum/geometry/patch_hierarchy.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace transillum {

/// Where leaf_in_root(triangle.level, ...) finds it.
[[nodiscard]] std::uint32_t number_of(const LeafTriangle& triangle);
/// The inverse of number_of.
[[nodiscard]] LeafTriangle triangle_of(int level, std::uint32_t number);

/// In the order of preorder. \pre the level is below max_subdivision_level
[[nodiscard]] std::array<LeafTriangle, 4> children_of(const LeafTriangle& triangle);

/// Corners in units of 2^-level, counter-clockwise as the root's.
[[nodiscard]] std::array<glm::ivec2, 3> corners_of(const LeafTriangle& triangle);

[[nodiscard]] constexpr std::uint64_t cells_of(int level) {
    return std::uint64_t{1} << (2 * level);
}

class HierarchyBuilder {
public:
    /// \param cells table entries of mixed roots, in all
    /// \throws UsageError above 2^30 leaves or cells.
    HierarchyBuilder(std::size_t roots, std::uint64_t leaves, std::uint64_t cells);

    /// \throws UsageError unless the level is in [0, max_subdivision_level].
    void add_uniform(int level);
    /// \param leaves of a whole tree, in preorder. Those of one level are added as uniform, so in
    /// the order of their numbers.
    void add(std::vector<LeafTriangle> leaves);

    [[nodiscard]] PatchHierarchy take() { return std::move(patches_); }
    [[nodiscard]] const RootPatches& last() const { return patches_.roots.back(); }

private:
    PatchHierarchy patches_;
};

/// \throws UsageError unless the level is in [0, max_subdivision_level].
void require_level(int level);

}  // namespace transillum
