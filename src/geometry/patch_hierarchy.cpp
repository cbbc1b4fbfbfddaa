#include <transillum/base/error.h>
#include <transillum/geometry/patch_hierarchy.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <string>

namespace transillum {

namespace {

/// Beyond one a triangle: enough for the walls of a room.
constexpr std::size_t leaves_by_default = 30000;

double longest_edge(const SurfaceMesh& mesh, const RootTriangle& t) {
    double longest = 0.0;
    for (int i = 0; i < 3; ++i)
        longest = std::max(longest, glm::distance(mesh.positions[t.vertices[i]],
                                                  mesh.positions[t.vertices[(i + 1) % 3]]));
    return longest;
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
double size_for_count(const std::vector<double>& edges, double target, int max_level) {
    double large = *std::max_element(edges.begin(), edges.end());
    double small = std::ldexp(large, -max_level - 1);
    for (int step = 0; step < 40; ++step) {
        const double middle = std::sqrt(small * large);
        double leaves = 0.0;
        for (const double edge : edges)
            leaves += std::ldexp(1.0, 2 * level_for(edge, middle, max_level));
        (leaves >= target ? small : large) = middle;
    }
    return small;
}

}  // namespace

std::array<glm::ivec2, 3> leaf_corners(const PatchHierarchy& patches, std::uint32_t leaf) {
    const RootPatches& root = patches.roots[patches.root_of_leaf[leaf]];
    const int n = 1 << root.level;
    int k = static_cast<int>(leaf - root.first_leaf);
    // Row i starts at i (2 n - i): invert, then mend the square root's rounding.
    int i = n - static_cast<int>(std::sqrt(static_cast<double>(n) * n - k));
    while (i > 0 && i * (2 * n - i) > k) --i;
    while ((i + 1) * (2 * n - i - 1) <= k) ++i;
    k -= i * (2 * n - i);
    const int j = k / 2;
    if (k % 2 == 0) return {glm::ivec2(i, j), glm::ivec2(i + 1, j), glm::ivec2(i, j + 1)};
    return {glm::ivec2(i + 1, j), glm::ivec2(i + 1, j + 1), glm::ivec2(i, j + 1)};
}

glm::dvec3 point_of_root(const SurfaceMesh& mesh, std::uint32_t root, glm::ivec2 b, int level) {
    const auto& v = mesh.triangles[root].vertices;
    const double n = std::ldexp(1.0, level);
    const glm::dvec3 sum = (n - b.x - b.y) * mesh.positions[v[0]] +
                           double(b.x) * mesh.positions[v[1]] + double(b.y) * mesh.positions[v[2]];
    return sum / n;
}

double leaf_area(const SurfaceMesh& mesh, const PatchHierarchy& patches, std::uint32_t root) {
    return std::ldexp(area_of(mesh, root), -2 * patches.roots[root].level);
}

PatchHierarchy subdivide_to_levels(const std::vector<int>& levels) {
    PatchHierarchy patches;
    std::uint64_t leaves = 0;
    for (const int level : levels) {
        if (level < 0 || level > max_subdivision_level)
            throw UsageError("subdivision level " + std::to_string(level) + "; accepted: 0 to " +
                             std::to_string(max_subdivision_level));
        leaves += std::uint64_t{1} << (2 * level);
    }
    if (leaves > (std::uint64_t{1} << 30))
        throw UsageError(std::to_string(leaves) +
                         " leaf patches; accepted: at most 2^30; raise the patch size");
    patches.root_of_leaf.reserve(leaves);
    for (std::uint32_t r = 0; r < levels.size(); ++r) {
        patches.roots.push_back({patches.leaf_count, levels[r]});
        patches.leaf_count += 1u << (2 * levels[r]);
        patches.root_of_leaf.resize(patches.leaf_count, r);
    }
    return patches;
}

glm::dvec3 leaf_centre(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                       std::uint32_t leaf) {
    const std::uint32_t root = patches.root_of_leaf[leaf];
    glm::dvec3 sum(0.0);
    for (const glm::ivec2 corner : leaf_corners(patches, leaf))
        sum += point_of_root(mesh, root, corner, patches.roots[root].level);
    return sum / 3.0;
}

PatchHierarchy subdivide_uniformly(const SurfaceMesh& mesh, const SubdivisionOptions& options) {
    if (!(options.patch_size >= 0.0) || std::isinf(options.patch_size))
        throw UsageError("patch size " + std::to_string(options.patch_size) +
                         "; accepted: 0 (automatic) or a length");
    if (options.max_level < 0 || options.max_level > max_subdivision_level)
        throw UsageError("max level " + std::to_string(options.max_level) + "; accepted: 0 to " +
                         std::to_string(max_subdivision_level));
    std::vector<double> edges;
    for (const RootTriangle& t : mesh.triangles) edges.push_back(longest_edge(mesh, t));
    const double target = options.leaf_target > 0
                              ? options.leaf_target
                              : static_cast<double>(edges.size() + leaves_by_default);
    const double size = options.patch_size > 0.0 ? options.patch_size
                                                 : size_for_count(edges, target, options.max_level);
    std::vector<int> levels;
    for (const double edge : edges) levels.push_back(level_for(edge, size, options.max_level));
    return subdivide_to_levels(levels);
}

}  // namespace transillum
