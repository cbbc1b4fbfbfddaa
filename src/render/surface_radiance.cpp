#include "render/surface_radiance.h"

#include "render/patch_areas.h"

#include <algorithm>
#include <functional>
#include <span>

namespace transillum {

namespace {

using Values = std::vector<Spectrum>;

Values values_of(const Solution& s, const VertexGrid* grid, const Components& components,
                 const Workers& workers) {
    const std::uint32_t leaves = s.patches.leaf_count;
    Values steady(s.patches.patch_count()), estimated(s.patches.patch_count());
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        steady[p] = (components.emission ? s.emission(p) : Spectrum(0.0f)) +
                    (components.direct ? s.direct_radiance(p) : Spectrum(0.0f));
        if (components.finite_element) estimated[p] = s.finite_element_radiance(p);
    }
    if (!grid) {
        std::ranges::transform(steady, estimated, steady.begin(), std::plus());
        return steady;
    }
    Values values;
    const std::vector<float> areas = patch_areas(s);
    for (const std::uint32_t side : {0u, leaves}) {
        const auto interpolate = [&](const Values& of_patches, const std::vector<float>& weights) {
            return vertex_values(*grid, std::span(of_patches).subspan(side, leaves),
                                 std::span(weights).subspan(side, leaves), workers);
        };
        const Values known = interpolate(steady, areas);
        const Values found = interpolate(estimated, s.coverage);
        for (std::size_t v = 0; v < known.size(); ++v) values.push_back(known[v] + found[v]);
    }
    return values;
}

}  // namespace

std::vector<Spectrum> surface_radiance(const SpectralSolution& spectral, const VertexGrid* grid,
                                       const Components& components, const Workers& workers) {
    if (spectral.groups.empty()) return values_of(spectral.rgb, grid, components, workers);
    const Bands bands(spectral.bands);
    Solution solution = spectral.rgb;
    std::vector<SpectrumSum> sums;  // double, as all of a picture's bands
    for (int g = 0; g < bands.groups(); ++g) {
        put_into_group(solution, spectral, bands, g);
        const Values values = values_of(solution, grid, components, workers);
        sums.resize(values.size(), SpectrumSum(0.0));
        for (std::size_t i = 0; i < values.size(); ++i)
            sums[i] += bands.rgb_from_group(g) * SpectrumSum(values[i]);
    }
    Values result;
    // Pure colours lie outside sRGB.
    for (const SpectrumSum& sum : sums) result.emplace_back(glm::max(sum, SpectrumSum(0.0)));
    return result;
}

}  // namespace transillum
