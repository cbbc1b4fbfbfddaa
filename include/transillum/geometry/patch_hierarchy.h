/// The finite-element structure over the root triangles: each is the root of a quadtree that splits
/// triangles 1-to-4 at their midpoints, and carries its elements on the leaves (paper §3.2, design:
/// PatchHierarchy). A leaf of level l has 4^-l of its root's area; leaves of one root may differ in
/// level.
///
/// Both sides of a surface share one subdivision, so one look-up serves both:
///   leaf   a triangle of the subdivision, numbered root by root
///   patch  one side of a leaf: patch = leaf for the front, leaf_count + leaf for the back
#pragma once

#include <transillum/geometry/surface_mesh.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace transillum {

inline constexpr int max_subdivision_level = 11;

/// Number of a leaf within a root of `level`, from barycentric coordinates (b1, b2) of the root's
/// second and third vertex. Rows run along b1; a row holds upright and turned triangles
/// alternately. Coordinates a rounding error outside the triangle are taken to the nearest leaf.
[[nodiscard]] inline std::uint32_t leaf_in_root(int level, float b1, float b2) {
    const float n = static_cast<float>(1 << level);
    const float last = n - n * 0x1p-22f;
    const float s = std::clamp(b1 * n, 0.0f, last);
    const float t = std::clamp(b2 * n, 0.0f, last);
    const float sum = std::min(s + t, last);
    const int i = static_cast<int>(s);
    const int j = static_cast<int>(t);
    const int diagonal = std::clamp(static_cast<int>(sum), i, i + j + 1);
    // diagonal - i is j for an upright triangle, j + 1 for a turned one
    const int column = std::min(j, diagonal - i);
    return static_cast<std::uint32_t>(i * (2 * (1 << level) - i) + column + (diagonal - i));
}

/// A half of a square of the subdivision that begins at (b1, b2) = (i, j) * 2^-level: the upright
/// one, which has a corner there, or the turned one, which has one opposite.
struct LeafTriangle {
    std::uint16_t i = 0, j = 0;
    std::uint8_t level = 0;
    bool turned = false;

    bool operator==(const LeafTriangle&) const = default;
};

/// What a root needs whose leaves differ in level: 4 bytes * 4^level of its smallest leaves, and 6
/// bytes a leaf.
struct MixedRoot {
    /// Leaf, counted from the root's first, by leaf_in_root() of the smallest leaves' level.
    std::vector<std::uint32_t> cells;
    /// In preorder. The children of a triangle: at its first, second and third corner, the middle.
    std::vector<LeafTriangle> leaves;

    bool operator==(const MixedRoot&) const = default;
};

struct RootPatches {
    static constexpr std::int32_t uniform = -1;

    std::uint32_t first_leaf = 0;
    std::int32_t level = 0;  ///< of its smallest leaves
    /// Index into PatchHierarchy::mixed_roots. Leaves that are all of one level are `uniform`,
    /// always: there are 4^level of them, in the order of leaf_in_root().
    std::int32_t mixed = uniform;

    bool operator==(const RootPatches&) const = default;
};

struct PatchHierarchy {
    std::vector<RootPatches> roots;  ///< one a root triangle
    std::vector<std::uint32_t> root_of_leaf;
    std::uint32_t leaf_count = 0;
    std::vector<MixedRoot> mixed_roots;

    bool operator==(const PatchHierarchy&) const = default;

    [[nodiscard]] std::uint32_t patch_count() const { return 2 * leaf_count; }
    /// The leaf that holds a point of a root.
    [[nodiscard]] std::uint32_t leaf_at(std::uint32_t root, float b1, float b2) const {
        const RootPatches& r = roots[root];
        const std::uint32_t cell = leaf_in_root(r.level, b1, b2);
        return r.first_leaf +
               (r.mixed == RootPatches::uniform ? cell : mixed_roots[r.mixed].cells[cell]);
    }
    /// Leaves of a root; they follow its first one.
    [[nodiscard]] std::uint32_t leaves_of(std::uint32_t root) const {
        const RootPatches& r = roots[root];
        return r.mixed == RootPatches::uniform
                   ? 1u << (2 * r.level)
                   : static_cast<std::uint32_t>(mixed_roots[r.mixed].leaves.size());
    }
    [[nodiscard]] int level_of_leaf(std::uint32_t leaf) const {
        const RootPatches& r = roots[root_of_leaf[leaf]];
        return r.mixed == RootPatches::uniform
                   ? r.level
                   : mixed_roots[r.mixed].leaves[leaf - r.first_leaf].level;
    }
    [[nodiscard]] std::uint32_t leaf_of_patch(std::uint32_t patch) const {
        return patch < leaf_count ? patch : patch - leaf_count;
    }
    [[nodiscard]] bool is_back(std::uint32_t patch) const { return patch >= leaf_count; }
};

/// Integer barycentric coordinates (b1, b2) in units of 2^-level of the root.
struct LeafCorners {
    /// Counter-clockwise as the root's, from the least b2 and, of these, the least b1.
    std::array<glm::ivec2, 3> b;
    int level = 0;  ///< of the leaf
};
[[nodiscard]] LeafCorners leaf_corners(const PatchHierarchy& patches, std::uint32_t leaf);

/// All corners of leaves up to `level` lie on a root's lattice, numbered row by row along b1.
[[nodiscard]] inline std::uint32_t lattice_number(int level, glm::ivec2 b) {
    return static_cast<std::uint32_t>(b.x * ((1 << level) + 1) - b.x * (b.x - 1) / 2 + b.y);
}
[[nodiscard]] inline std::uint32_t lattice_size(int level) {
    return ((1u << level) + 1) * ((1u << level) + 2) / 2;
}

/// The point of a root at (b1, b2) / 2^level; exact for snapped vertices.
[[nodiscard]] glm::dvec3 point_of_root(const SurfaceMesh& mesh, std::uint32_t root, glm::ivec2 b,
                                       int level);

/// The corners of a leaf.
[[nodiscard]] std::array<glm::dvec3, 3> points_of_leaf(const SurfaceMesh& mesh,
                                                       const PatchHierarchy& patches,
                                                       std::uint32_t leaf);

/// [square scene units]
[[nodiscard]] double area_of_leaf(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                  std::uint32_t leaf);

/// Centre of gravity of a leaf.
[[nodiscard]] glm::dvec3 leaf_centre(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                     std::uint32_t leaf);

struct SubdivisionOptions {
    double patch_size = 0.0;  ///< longest edge a leaf may have [scene units]; 0: from leaf_target
    /// Leaves are made about alike in size, the geometric mean of their longest edge and that of
    /// an equilateral triangle of their area, so that there are about this many. 0: 30000 more
    /// than triangles, or twice as many as these, but none of less than a 240000th of the surface
    /// is divided.
    std::uint32_t leaf_target = 0;
    int max_level = 8;  ///< at most max_subdivision_level
};

/// Subdivides every root until its leaves' longest edge is at most the patch size, or by count.
/// \throws UsageError on a negative size, a level outside [0, max_subdivision_level], or above 2^30
/// leaves.
[[nodiscard]] PatchHierarchy subdivide_uniformly(const SurfaceMesh& mesh,
                                                 const SubdivisionOptions& options);

/// A hierarchy of given levels, one a root. \throws UsageError as above.
[[nodiscard]] PatchHierarchy subdivide_to_levels(const std::vector<int>& levels);

}  // namespace transillum
