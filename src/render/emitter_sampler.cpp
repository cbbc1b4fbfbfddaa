#include "render/emitter_sampler.h"

#include <algorithm>
#include <cmath>

namespace transillum {

EmitterSampler::EmitterSampler(const SurfaceMesh& mesh, const std::vector<Facet>& facets)
    : facets_(facets), mesh_(mesh) {
    for (std::uint32_t root = 0; root < mesh.triangles.size(); ++root)
        for (const bool back : {false, true}) {
            const Material& material = mesh.materials[mesh.triangles[root].material];
            const double flux = mean_channel(emission_of(material, back)) * facets[root].area;
            if (!(flux > 0.0)) continue;
            sides_.push_back({root, back});
            cumulative_.push_back(total_ += flux);
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
    const Facet& facet = facets_[sides_[i].root];
    const Spectrum radiance =
        emission_of(mesh_.materials[mesh_.triangles[sides_[i].root].material], sides_[i].back);
    return {facet.point(s * (1.0 - u.y), s * u.y), facet.side_normal(sides_[i].back), radiance,
            density(radiance)};
}

}  // namespace transillum
