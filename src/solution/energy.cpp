#include "solution/energy.h"

#include <fmt/format.h>

#include <numbers>

namespace transillum {

namespace {

/// Share of the flux on sharp lobes from which it is worth a word.
constexpr double much_on_sharp_lobes = 0.01;

/// Flux of lights without extent on the surface; what they send past it nobody misses.
SpectrumSum arrived_from_lights(const Solution& s) {
    SpectrumSum sum(0.0);
    for (std::size_t i = 0; i < s.direct.columns(); ++i) {
        if (s.direct.light(i).kind == LightSample::Kind::area) continue;
        double share = 0.0;
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p)
            share += area_of_leaf(s.surface, s.patches, s.patches.leaf_of_patch(p)) *
                     s.direct.share(p, i);
        sum += share * SpectrumSum(s.direct.light(i).emitted);
    }
    return sum;
}

}  // namespace

Spectrum reflected_share(const Solution& s, std::uint32_t patch) {
    const GlossySide* const side = s.glossy_side(patch);
    if (!side) return s.diffuse(patch);
    Brdf brdf = s.glossy.brdfs[side->brdf];
    brdf.diffuse = s.diffuse(patch);
    return mean_albedo(brdf);
}

EnergyBalance measure_first_shot(const Solution& s) {
    EnergyBalance balance;
    SpectrumSum shot(0.0), arrived(0.0);
    for (const LightSample& l : s.direct.samples)
        shot += SpectrumSum(l.emitted) * (std::numbers::pi * l.area);
    balance.entered = arrived_from_lights(s);
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        const double area = area_of_leaf(s.surface, s.patches, s.patches.leaf_of_patch(p));
        const SpectrumSum direct = area * SpectrumSum(s.direct_irradiance[p]);
        arrived += direct;
        if (!s.reflects(p)) balance.black_backs += direct;
    }
    balance.escaped = glm::max(shot - (arrived - balance.entered), SpectrumSum(0.0));
    return balance;
}

EnergyBalance measure_balance(const Solution& s, const EnergyBalance& first_shot,
                              const TransportResult& transport) {
    EnergyBalance balance = first_shot;
    balance.escaped += transport.escaped;
    balance.entered += transport.entered;
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        const double area = area_of_leaf(s.surface, s.patches, s.patches.leaf_of_patch(p));
        const SpectrumSum indirect = area * SpectrumSum(s.indirect_irradiance[p]);
        const SpectrumSum flux = area * SpectrumSum(s.direct_irradiance[p]) + indirect;
        balance.emitted += area * std::numbers::pi * SpectrumSum(s.emission(p));
        const SpectrumSum reflected(s.direct_radiance(p) + s.finite_element_radiance(p));
        if (s.reflects(p))
            balance.absorbed += flux - area * std::numbers::pi * reflected;
        else
            balance.black_backs += indirect;
    }
    return balance;
}

void warn_of_sharp_lobes(const Solution& s, Monitor& monitor) {
    SpectrumSum on_sharp(0.0), reflected(0.0);
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        const double area = area_of_leaf(s.surface, s.patches, s.patches.leaf_of_patch(p));
        reflected += area * SpectrumSum(s.direct_radiance(p) + s.finite_element_radiance(p));
        const GlossySide* const side = s.glossy_side(p);
        if (!side || !is_sharper_than_bins(s.glossy.brdfs[side->brdf])) continue;
        Brdf lobe = s.glossy.brdfs[side->brdf];
        lobe.diffuse = Spectrum(0.0f);
        on_sharp +=
            area * std::numbers::inv_pi *
            SpectrumSum(mean_albedo(lobe) * (s.direct_irradiance[p] + s.indirect_irradiance[p]));
    }
    const double share = luminance(on_sharp) / luminance(reflected);
    if (share > much_on_sharp_lobes)
        monitor.warn(
            fmt::format("{:.1f} % of the reflected flux meets lobes sharper than direction "
                        "bins can hold: what they cast on other surfaces is blurred",
                        100.0 * share));
}

}  // namespace transillum
