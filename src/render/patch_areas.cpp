#include "render/patch_areas.h"

namespace transillum {

std::vector<float> patch_areas(const Solution& solution) {
    std::vector<float> areas(solution.patches.patch_count());
    for (std::uint32_t patch = 0; patch < areas.size(); ++patch) {
        const std::uint32_t leaf = solution.patches.leaf_of_patch(patch);
        areas[patch] = static_cast<float>(area_of_leaf(solution.surface, solution.patches, leaf));
    }
    return areas;
}

}  // namespace transillum
