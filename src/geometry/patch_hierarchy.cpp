#include <transillum/base/error.h>
#include <transillum/geometry/patch_hierarchy.h>

#include "geometry/hierarchy_builder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace transillum {

namespace {

/// Beyond one a triangle: enough for the walls of a room, and as many as there are triangles where
/// furniture makes the most of these.
constexpr std::size_t least_leaves_beyond = 30000;
/// Of the surface. By default nothing smaller is divided for the sake of the count: a fine mesh is
/// its own subdivision.
constexpr double smallest_share = 1.0 / 240000.0;

double longest_edge(const SurfaceMesh& mesh, const RootTriangle& t) {
    double longest = 0.0;
    for (int i = 0; i < 3; ++i)
        longest = std::max(longest, glm::distance(mesh.positions[t.vertices[i]],
                                                  mesh.positions[t.vertices[(i + 1) % 3]]));
    return longest;
}

double edge_of_equilateral(double area) {
    return std::sqrt(area / (0.25 * std::numbers::sqrt3));
}

/// By edges alone slivers, of which a repaired scene has many, would take most of the leaves that
/// are to be had; by area alone leaves would be long where light changes along a sliver.
double size_of(const SurfaceMesh& mesh, std::uint32_t root) {
    return std::sqrt(longest_edge(mesh, mesh.triangles[root]) *
                     edge_of_equilateral(area_of(mesh, root)));
}

int level_for(double edge, double patch_size, int max_level) {
    int level = 0;
    while (level < max_level && edge > patch_size) {
        edge *= 0.5;
        ++level;
    }
    return level;
}

/// The largest size, by bisection of its logarithm, that makes at least `target` leaves.
double size_for_count(const std::vector<double>& sizes, double target, int max_level) {
    double large = *std::max_element(sizes.begin(), sizes.end());
    double small = std::ldexp(large, -max_level - 1);
    for (int step = 0; step < 40; ++step) {
        const double middle = std::sqrt(small * large);
        double leaves = 0.0;
        for (const double size : sizes)
            leaves += std::ldexp(1.0, 2 * level_for(size, middle, max_level));
        (leaves >= target ? small : large) = middle;
    }
    return small;
}

}  // namespace

LeafCorners leaf_corners(const PatchHierarchy& patches, std::uint32_t leaf) {
    const RootPatches& r = patches.roots[patches.root_of_leaf[leaf]];
    const std::uint32_t k = leaf - r.first_leaf;
    const LeafTriangle triangle = r.mixed == RootPatches::uniform
                                      ? triangle_of(r.level, k)
                                      : patches.mixed_roots[r.mixed].leaves[k];
    return {corners_of(triangle), triangle.level};
}

glm::dvec3 point_of_root(const SurfaceMesh& mesh, std::uint32_t root, glm::ivec2 b, int level) {
    const auto& v = mesh.triangles[root].vertices;
    const double n = std::ldexp(1.0, level);
    const glm::dvec3 sum = (n - b.x - b.y) * mesh.positions[v[0]] +
                           double(b.x) * mesh.positions[v[1]] + double(b.y) * mesh.positions[v[2]];
    return sum / n;
}

std::array<glm::dvec3, 3> points_of_leaf(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                         std::uint32_t leaf) {
    const LeafCorners corners = leaf_corners(patches, leaf);
    std::array<glm::dvec3, 3> points;
    for (int i = 0; i < 3; ++i)
        points[i] = point_of_root(mesh, patches.root_of_leaf[leaf], corners.b[i], corners.level);
    return points;
}

double area_of_leaf(const SurfaceMesh& mesh, const PatchHierarchy& patches, std::uint32_t leaf) {
    return std::ldexp(area_of(mesh, patches.root_of_leaf[leaf]), -2 * patches.level_of_leaf(leaf));
}

PatchHierarchy subdivide_to_levels(const std::vector<int>& levels) {
    std::uint64_t leaves = 0;
    for (const int level : levels) {
        require_level(level);
        leaves += cells_of(level);
    }
    HierarchyBuilder builder(levels.size(), leaves, 0);
    for (const int level : levels) builder.add_uniform(level);
    return builder.take();
}

glm::dvec3 leaf_centre(const SurfaceMesh& mesh, const PatchHierarchy& patches, std::uint32_t leaf) {
    const auto [a, b, c] = points_of_leaf(mesh, patches, leaf);
    return (a + b + c) / 3.0;
}

PatchHierarchy subdivide_uniformly(const SurfaceMesh& mesh, const SubdivisionOptions& options) {
    if (!(options.patch_size >= 0.0) || std::isinf(options.patch_size))
        throw UsageError("patch size " + std::to_string(options.patch_size) +
                         "; accepted: 0 (automatic) or a length");
    if (options.max_level < 0 || options.max_level > max_subdivision_level)
        throw UsageError("max level " + std::to_string(options.max_level) + "; accepted: 0 to " +
                         std::to_string(max_subdivision_level));
    const bool by_count = options.patch_size == 0.0;
    std::vector<double> sizes;
    double surface = 0.0;
    for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r) {
        sizes.push_back(by_count ? size_of(mesh, r) : longest_edge(mesh, mesh.triangles[r]));
        surface += area_of(mesh, r);
    }
    double size = options.patch_size;
    if (by_count && options.leaf_target > 0)
        size = size_for_count(sizes, options.leaf_target, options.max_level);
    else if (by_count)
        size = std::max(
            edge_of_equilateral(smallest_share * surface),
            size_for_count(
                sizes,
                static_cast<double>(sizes.size() + std::max(sizes.size(), least_leaves_beyond)),
                options.max_level));
    std::vector<int> levels;
    for (const double s : sizes) levels.push_back(level_for(s, size, options.max_level));
    return subdivide_to_levels(levels);
}

}  // namespace transillum
