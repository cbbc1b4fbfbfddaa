#include "solution/incoming_light.h"

#include <algorithm>

namespace transillum {

namespace {

/// A patch that a light reaches may have its centre a little behind the light's horizon.
constexpr double least_cosine = 0.02;

glm::vec3 raised(glm::dvec3 direction) {
    direction = glm::normalize(direction);
    direction.z = std::max(direction.z, least_cosine);
    return glm::vec3(glm::normalize(direction));
}

}  // namespace

void append_incoming_light(const Solution& solution, std::uint32_t patch,
                           std::vector<IncomingLight>& incoming) {
    const DirectLight& light = solution.direct;
    if (light.columns() == 0) return;
    const std::uint32_t leaf = solution.patches.leaf_of_patch(patch);
    const std::uint32_t root = solution.patches.root_of_leaf[leaf];
    const glm::dvec3 centre = leaf_centre(solution.surface, solution.patches, leaf);
    const glm::dvec3 normal =
        normal_of(solution.surface, root) * (solution.patches.is_back(patch) ? -1.0 : 1.0);
    const glm::dmat3 local_from_world = glm::transpose(bin_frame(normal));
    for (std::size_t i = 0; i < light.columns(); ++i) {
        const auto share = static_cast<float>(light.share(patch, i));
        if (!(share > 0.0f)) continue;
        const LightSample& sample = light.light(i);
        const glm::vec3 way = raised(local_from_world * light.direction(patch, i, centre));
        const bool has_extent = sample.kind == LightSample::Kind::area;
        incoming.push_back({way, sample.emitted * share, has_extent ? share / way.z : 0.0f});
    }
}

}  // namespace transillum
