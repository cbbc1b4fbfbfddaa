#include "solution/leaf_colours.h"

#include <transillum/geometry/leaf_means.h>

#include <algorithm>

namespace transillum {

namespace {

/// Means of one property over all leaves; empty where it is uniform on every root.
std::vector<Spectrum> leaf_means(const Solution& s, std::int32_t MaterialTextures::*texture,
                                 Spectrum Material::*uniform) {
    const auto index_of = [&](const RootTriangle& t) {
        return s.surface.materials[t.material].textures.*texture;
    };
    std::vector<Spectrum> means;
    if (std::ranges::none_of(s.surface.triangles,
                             [&](const RootTriangle& t) { return index_of(t) >= 0; }))
        return means;
    means.reserve(s.patches.leaf_count);
    for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf) {
        const RootTriangle& t = s.surface.triangles[s.patches.root_of_leaf[leaf]];
        const std::int32_t index = index_of(t);
        means.push_back(index < 0
                            ? s.surface.materials[t.material].*uniform
                            : texture_mean_over_leaf(
                                  s.surface, s.patches,
                                  *s.surface.textures[static_cast<std::size_t>(index)], leaf));
    }
    return means;
}

}  // namespace

void average_textures(Solution& solution) {
    solution.leaf_diffuse = leaf_means(solution, &MaterialTextures::diffuse, &Material::diffuse);
    solution.leaf_emission = leaf_means(solution, &MaterialTextures::emission, &Material::emission);
}

}  // namespace transillum
