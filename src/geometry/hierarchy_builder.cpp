#include "geometry/hierarchy_builder.h"

#include <transillum/base/error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace transillum {

namespace {

/// Of leaves, and of entries of tables.
constexpr std::uint64_t most = std::uint64_t{1} << 30;

/// Triangle k of row i has this number plus k.
std::uint32_t start_of_row(int level, int i) {
    return static_cast<std::uint32_t>(i * (2 * (1 << level) - i));
}

/// A leaf has a run of cells in every row of the finest grid that it crosses.
void fill_cells(const LeafTriangle& leaf, std::uint32_t number, int level,
                std::vector<std::uint32_t>& cells) {
    const int size = 1 << (level - leaf.level);
    for (int row = 0; row < size; ++row) {
        const int first = leaf.turned ? 2 * ((leaf.j + 1) * size - row) - 1 : 2 * leaf.j * size;
        const int count = leaf.turned ? 2 * row + 1 : 2 * (size - row) - 1;
        std::fill_n(cells.begin() + start_of_row(level, leaf.i * size + row) + first, count,
                    number);
    }
}

}  // namespace

std::uint32_t number_of(const LeafTriangle& triangle) {
    return start_of_row(triangle.level, triangle.i) +
           static_cast<std::uint32_t>(2 * triangle.j + (triangle.turned ? 1 : 0));
}

LeafTriangle triangle_of(int level, std::uint32_t number) {
    const double n = 1 << level;
    // Row i starts at i (2 n - i): invert, then mend the square root's rounding.
    int i = static_cast<int>(n - std::sqrt(n * n - number));
    while (i > 0 && start_of_row(level, i) > number) --i;
    while (start_of_row(level, i + 1) <= number) ++i;
    const std::uint32_t k = number - start_of_row(level, i);
    return {static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(k / 2),
            static_cast<std::uint8_t>(level), k % 2 != 0};
}

std::array<LeafTriangle, 4> children_of(const LeafTriangle& triangle) {
    const auto child = [&](int di, int dj, bool turned) {
        return LeafTriangle{static_cast<std::uint16_t>(2 * triangle.i + di),
                            static_cast<std::uint16_t>(2 * triangle.j + dj),
                            static_cast<std::uint8_t>(triangle.level + 1), turned};
    };
    if (triangle.turned)
        return {child(1, 0, true), child(1, 1, true), child(0, 1, true), child(1, 1, false)};
    return {child(0, 0, false), child(1, 0, false), child(0, 1, false), child(0, 0, true)};
}

std::array<glm::ivec2, 3> corners_of(const LeafTriangle& triangle) {
    const int i = triangle.i, j = triangle.j;
    if (triangle.turned)
        return {glm::ivec2(i + 1, j), glm::ivec2(i + 1, j + 1), glm::ivec2(i, j + 1)};
    return {glm::ivec2(i, j), glm::ivec2(i + 1, j), glm::ivec2(i, j + 1)};
}

void require_level(int level) {
    if (level < 0 || level > max_subdivision_level)
        throw UsageError("subdivision level " + std::to_string(level) + "; accepted: 0 to " +
                         std::to_string(max_subdivision_level));
}

HierarchyBuilder::HierarchyBuilder(std::size_t roots, std::uint64_t leaves, std::uint64_t cells) {
    if (leaves > most)
        throw UsageError(std::to_string(leaves) +
                         " leaf patches; accepted: at most 2^30; raise the patch size");
    if (cells > most)
        throw UsageError("triangles with leaves of several levels: tables of " +
                         std::to_string(cells) +
                         " entries; accepted: at most 2^30; lower the deepest level");
    patches_.roots.reserve(roots);
    patches_.root_of_leaf.reserve(leaves);
}

void HierarchyBuilder::add_uniform(int level) {
    require_level(level);
    const auto root = static_cast<std::uint32_t>(patches_.roots.size());
    patches_.roots.push_back({patches_.leaf_count, level});
    patches_.leaf_count += 1u << (2 * level);
    patches_.root_of_leaf.resize(patches_.leaf_count, root);
}

void HierarchyBuilder::add(std::vector<LeafTriangle> leaves) {
    const auto [highest, deepest] = std::ranges::minmax(leaves, {}, &LeafTriangle::level);
    const int level = deepest.level;
    if (highest.level == level) return add_uniform(level);
    const auto root = static_cast<std::uint32_t>(patches_.roots.size());
    patches_.roots.push_back(
        {patches_.leaf_count, level, static_cast<std::int32_t>(patches_.mixed_roots.size())});
    patches_.leaf_count += static_cast<std::uint32_t>(leaves.size());
    patches_.root_of_leaf.resize(patches_.leaf_count, root);
    MixedRoot& mixed = patches_.mixed_roots.emplace_back();
    mixed.leaves = std::move(leaves);
    mixed.cells.resize(cells_of(level));
    for (std::uint32_t k = 0; k < mixed.leaves.size(); ++k)
        fill_cells(mixed.leaves[k], k, level, mixed.cells);
}

}  // namespace transillum
