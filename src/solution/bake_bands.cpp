#include <transillum/solution/bake_bands.h>

#include "solution/baker.h"
#include "solution/energy.h"
#include "solution/group_colours.h"

#include <transillum/base/part_monitor.h>
#include <transillum/first_shot/shoot_direct_light.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace transillum {

namespace {

/// Sum over the groups of values, one an element, converted to RGB.
class RgbSum {
public:
    void add(const glm::dmat3& rgb_from_group, const std::vector<Spectrum>& values) {
        sums_.resize(values.size(), SpectrumSum(0.0));
        for (std::size_t i = 0; i < values.size(); ++i)
            sums_[i] += rgb_from_group * SpectrumSum(values[i]);
    }
    /// What lies outside sRGB is cut off.
    [[nodiscard]] std::vector<Spectrum> values() const {
        std::vector<Spectrum> result;
        for (const SpectrumSum& s : sums_) result.emplace_back(glm::max(s, SpectrumSum(0.0)));
        return result;
    }
    [[nodiscard]] std::vector<Spectrum> magnitudes() const {
        std::vector<Spectrum> result;
        for (const SpectrumSum& s : sums_) result.emplace_back(glm::abs(s));
        return result;
    }

private:
    std::vector<SpectrumSum> sums_;
};

/// What of the groups' results becomes that of RGB.
struct Converted {
    RgbSum direct, indirect, error, glossy;
    std::vector<float> coverage;
    EnergyBalance balance;
    std::uint64_t iterations = 0;
    double relative_error = 0.0;

    void add(const glm::dmat3& rgb_from_group, const Solution& s) {
        direct.add(rgb_from_group, s.direct_irradiance);
        indirect.add(rgb_from_group, s.indirect_irradiance);
        error.add(rgb_from_group, s.standard_error);
        glossy.add(rgb_from_group, s.glossy_elements);
        coverage.resize(s.coverage.size(), 0.0f);
        for (std::size_t p = 0; p < coverage.size(); ++p)
            coverage[p] = std::max(coverage[p], s.coverage[p]);
        for (const auto flux :
             {&EnergyBalance::emitted, &EnergyBalance::entered, &EnergyBalance::absorbed,
              &EnergyBalance::escaped, &EnergyBalance::black_backs})
            balance.*flux += rgb_from_group * s.balance.*flux;
        iterations = std::max(iterations, s.iterations);
        relative_error = std::max(relative_error, s.relative_error);
    }

    void put_into(Solution& s) const {
        s.direct_irradiance = direct.values();
        s.indirect_irradiance = indirect.values();
        // All bands were met by the same directions: their errors go together.
        s.standard_error = error.magnitudes();
        s.glossy_elements = glossy.values();
        s.coverage = coverage;
        s.balance = balance;
        s.iterations = iterations;
        s.relative_error = relative_error;
    }
};

BandGroup take_group(Solution& s) {
    BandGroup group;
    for (const Material& m : s.surface.materials)
        group.materials.push_back({m.diffuse, m.specular, m.emission});
    group.direct_irradiance = std::move(s.direct_irradiance);
    group.indirect_irradiance = std::move(s.indirect_irradiance);
    group.standard_error = std::move(s.standard_error);
    group.glossy_elements = std::move(s.glossy_elements);
    return group;
}

/// Groups decide alike but for those that have no light, and where something was measured.
/// \param group its name, or empty for what holds for all
void add_new(std::vector<Decision>& decisions, const std::vector<Decision>& of_group,
             const std::string& group) {
    for (const Decision& d : of_group)
        if (std::ranges::none_of(decisions, [&](const Decision& k) { return k.what == d.what; }))
            decisions.push_back({group.empty() ? d.what : group + ": " + d.what, d.why});
}

std::string name_of(const Bands& bands, int group) {
    return fmt::format("{:.0f} to {:.0f} nm", bands.edge(bands.band_of(group, 0)),
                       bands.edge(bands.band_of(group, channel_count - 1) + 1));
}

}  // namespace

SpectralSolution bake_bands(const Scene& scene, const SpectralOptions& spectral,
                            const BakeOptions& options, const Workers& workers, Monitor& monitor,
                            RunRecord* run) {
    StopWatch watch(run);
    const Bands bands(spectral.bands);
    RepairedScene sound = make_sound(scene, options.repair, workers, monitor);
    watch.lap("repair");
    const Colours of_scene{sound.scene.materials, sound.scene.textures, sound.scene.lighting};
    const Colours rgb = measured_colours(of_scene, spectral, bands, monitor);
    BakeOptions of_group = options;
    of_group.iteration.seconds /= bands.groups();
    of_group.iteration.keep_sums = false;  // nothing goes on from a group's

    Baker baker(of_group, workers, monitor, watch);
    sound.scene.materials = rgb.materials;
    sound.scene.textures = rgb.textures;
    sound.scene.lighting = rgb.lighting;
    Layout layout = lay_out_solution(std::move(sound), options, baker, watch, monitor);
    baker.band_groups = static_cast<std::uint64_t>(bands.groups());
    Solution& s = layout.solution;
    std::vector<Decision>& decisions = layout.decisions;
    baker.prepare(s, layout.refined.bin_levels);
    decisions.push_back({fmt::format("{} bands of {:.4g} nm in {} groups", bands.count(),
                                     bands.edge(1) - bands.edge(0), bands.groups()),
                         "asked for"});
    add_new(decisions, s.decisions, {});

    SpectralSolution result;
    result.bands = bands.count();
    Converted converted;
    for (int g = 0; g < bands.groups(); ++g) {
        PartMonitor part(monitor, name_of(bands, g));
        put_colours(s, measured_colours_in_group(of_scene, spectral, bands, g, part));
        s.direct_irradiance = direct_irradiance(s.direct, s.patches.patch_count());
        s.decisions.clear();
        Baker(of_group, workers, part, watch).transport(s, options.iteration.iterations);
        add_new(decisions, s.decisions, g == 0 ? std::string() : name_of(bands, g));
        converted.add(bands.rgb_from_group(g), s);
        result.groups.push_back(take_group(s));
    }
    put_colours(s, rgb);
    s.spatial_error.clear();  // a group's own
    s.directional_error.clear();
    converted.put_into(s);
    s.settings.emplace_back("spectral", fmt::format("{}", bands.count()));
    s.decisions = std::move(decisions);
    warn_of_sharp_lobes(s, monitor);
    for (const Decision& d : s.decisions) monitor.note(d.what + ": " + d.why);
    if (s.interrupted)
        monitor.warn(
            "interrupted: bands have different numbers of iterations, some none: colours "
            "are off");
    if (run) run->threads = workers.count();
    result.rgb = std::move(s);
    return result;
}

}  // namespace transillum
