#include <transillum/solution/stored_patches.h>

namespace transillum {

namespace {

bool shines(const Solution& solution, std::uint32_t patch) {
    const Spectrum zero(0.0f);
    return solution.emission(patch) != zero || solution.direct_irradiance[patch] != zero ||
           solution.indirect_irradiance[patch] != zero;
}

bool stores_side(const Solution& solution, std::uint32_t first, std::uint32_t count) {
    if (!solution.reflects(first) && !solution.emits(first)) return false;
    for (std::uint32_t patch = first; patch < first + count; ++patch) {
        if (shines(solution, patch)) return true;
    }
    return false;
}

}  // namespace

std::vector<std::uint32_t> stored_patches(const Solution& solution) {
    std::vector<std::uint32_t> stored;
    for (const std::uint32_t side_offset : {0u, solution.patches.leaf_count}) {
        for (std::uint32_t root = 0; root < solution.patches.roots.size(); ++root) {
            const std::uint32_t first = side_offset + solution.patches.roots[root].first_leaf;
            const std::uint32_t count = solution.patches.leaves_of(root);
            if (!stores_side(solution, first, count)) continue;
            for (std::uint32_t i = 0; i < count; ++i) stored.push_back(first + i);
        }
    }
    return stored;
}

}  // namespace transillum
