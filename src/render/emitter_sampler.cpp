#include "render/emitter_sampler.h"

#include "render/surface_at.h"

#include <algorithm>
#include <cmath>

namespace transillum {

EmitterSampler::EmitterSampler(const SurfaceMesh& mesh, const std::vector<Facet>& facets)
    : facets_(facets), mesh_(mesh) {
    for (std::uint32_t root = 0; root < mesh.triangles.size(); ++root) {
        const Material& material = mesh.materials[mesh.triangles[root].material];
        if (!material.emits()) continue;
        const double flux = mean_channel(mean_emission(mesh, root)) * facets[root].area;
        if (!(flux > 0.0)) continue;
        for (const bool back : {false, true}) {
            if (back && !material.back_emits) continue;
            sides_.push_back({root, back});
            cumulative_.push_back(total_ += flux);
        }
    }
    if (sides_.empty()) return;
    densities_.resize(2 * mesh.triangles.size());
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        const double flux = cumulative_[i] - (i == 0 ? 0.0 : cumulative_[i - 1]);
        densities_[2 * static_cast<std::size_t>(sides_[i].root) + sides_[i].back] =
            flux / (facets[sides_[i].root].area * total_);
    }
}

EmitterPoint EmitterSampler::sample(glm::vec2 u) const {
    const double target = u.x * total_;
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), target);
    const std::size_t i = std::min<std::size_t>(found - cumulative_.begin(), sides_.size() - 1);
    const double before = i == 0 ? 0.0 : cumulative_[i - 1];
    // What chose the side is spread over it again, so that the pair stays stratified.
    const double rest = std::clamp((target - before) / (cumulative_[i] - before), 0.0, 1.0);
    const double s = std::sqrt(rest);
    const double b1 = s * (1.0 - u.y), b2 = s * u.y;
    const auto [root, back] = sides_[i];
    return {facets_[root].point(b1, b2), facets_[root].side_normal(back),
            emission_at(mesh_, root, b1, b2), density(root, back)};
}

}  // namespace transillum
