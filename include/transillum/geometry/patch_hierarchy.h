/// The finite-element structure over the root triangles: each is subdivided 1-to-4 in barycentric
/// coordinates, and carries its elements on the leaves (paper §3, design: PatchHierarchy).
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

struct RootPatches {
    std::uint32_t first_leaf = 0;
    std::int32_t level = 0;  ///< uniform subdivision: 4^level leaves
};

struct PatchHierarchy {
    std::vector<RootPatches> roots;  ///< one a root triangle
    std::vector<std::uint32_t> root_of_leaf;
    std::uint32_t leaf_count = 0;

    [[nodiscard]] std::uint32_t patch_count() const { return 2 * leaf_count; }
    [[nodiscard]] std::uint32_t leaf_at(std::uint32_t root, float b1, float b2) const {
        return roots[root].first_leaf + leaf_in_root(roots[root].level, b1, b2);
    }
    [[nodiscard]] std::uint32_t leaf_of_patch(std::uint32_t patch) const {
        return patch < leaf_count ? patch : patch - leaf_count;
    }
    [[nodiscard]] bool is_back(std::uint32_t patch) const { return patch >= leaf_count; }
};

/// Corners of a leaf as integer barycentric coordinates (b1, b2) in units of 2^-level of its root,
/// counter-clockwise as the root's.
[[nodiscard]] std::array<glm::ivec2, 3> leaf_corners(const PatchHierarchy& patches,
                                                     std::uint32_t leaf);

/// The point of a root at (b1, b2) / 2^level; exact for snapped vertices.
[[nodiscard]] glm::dvec3 point_of_root(const SurfaceMesh& mesh, std::uint32_t root, glm::ivec2 b,
                                       int level);

/// Area of every leaf of a root [square scene units].
[[nodiscard]] double leaf_area(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                               std::uint32_t root);

/// Centre of gravity of a leaf.
[[nodiscard]] glm::dvec3 leaf_centre(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                     std::uint32_t leaf);

struct SubdivisionOptions {
    double patch_size = 0.0;  ///< longest edge a leaf may have [scene units]; 0: from leaf_target
    std::uint32_t leaf_target = 0;  ///< the size is chosen so that there are about this many
                                    ///< leaves; 0: 30000 more than triangles
    int max_level = 8;              ///< at most max_subdivision_level
};

/// Subdivides every root until its leaves' longest edge is at most the patch size.
/// \throws UsageError on a negative size, a level outside [0, max_subdivision_level], or above 2^30
/// leaves.
[[nodiscard]] PatchHierarchy subdivide_uniformly(const SurfaceMesh& mesh,
                                                 const SubdivisionOptions& options);

/// A hierarchy of given levels, one a root.
[[nodiscard]] PatchHierarchy subdivide_to_levels(const std::vector<int>& levels);

}  // namespace transillum
