#include <transillum/solution/patch_sources.h>

#include "solution/incoming_light.h"

namespace transillum {

PatchSources make_sources(const Solution& s) {
    const std::uint32_t n = s.patches.patch_count();
    PatchSources sources;
    sources.emission.resize(n);
    sources.direct.resize(n);
    sources.albedo.resize(n);
    sources.glossy = s.glossy;
    sources.environment = s.lighting.environment;
    const bool reflects_first_shot = !s.glossy.empty() && !s.direct.samples.empty();
    if (reflects_first_shot) sources.first_incoming.push_back(0);
    for (std::uint32_t p = 0; p < n; ++p) {
        const std::uint32_t root = s.patches.root_of_leaf[s.patches.leaf_of_patch(p)];
        const bool back = s.patches.is_back(p);
        const bool shot = s.direct.shot_sides[2 * root + (back ? 1 : 0)] != 0;
        sources.albedo[p] = s.diffuse(p);
        sources.emission[p] = shot ? Spectrum(0.0f) : s.emission(p);
        sources.direct[p] = s.direct_radiance(p);
        if (!reflects_first_shot) continue;
        if (s.glossy.find(root, back)) append_incoming_light(s, p, sources.incoming);
        sources.first_incoming.push_back(static_cast<std::uint32_t>(sources.incoming.size()));
    }
    return sources;
}

bool shines(const PatchSources& sources) {
    const auto is_lit = [](const Spectrum& s) { return max_channel(s) > 0.0f; };
    return sources.environment.shines() || std::ranges::any_of(sources.emission, is_lit) ||
           std::ranges::any_of(sources.direct, is_lit);
}

}  // namespace transillum
