#include <transillum/base/error.h>
#include <transillum/first_shot/shoot_direct_light.h>
#include <transillum/solution/emitter_solution.h>

#include "solution/emitter_colours.h"
#include "solution/group_colours.h"
#include "solution/scene_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace transillum {

namespace {

void add_emitter(Emitter emitter, std::vector<Emitter>& emitters) {
    const std::string name = emitter.name;
    for (int i = 2; std::ranges::find(emitters, emitter.name, &Emitter::name) != emitters.end();
         ++i)
        emitter.name = fmt::format("{}#{}", name, i);
    emitters.push_back(std::move(emitter));
}

constexpr auto fluxes = {&EnergyBalance::emitted, &EnergyBalance::entered, &EnergyBalance::absorbed,
                         &EnergyBalance::escaped, &EnergyBalance::black_backs};
constexpr auto tables = {&EmitterPart::indirect_irradiance, &EmitterPart::standard_error,
                         &EmitterPart::glossy_elements};

std::vector<Spectrum> sum_of(const EmitterSolution& s, std::vector<Spectrum> EmitterPart::*table,
                             std::size_t size) {
    std::vector<Spectrum> sums(size);
    for (std::size_t i = 0; i < size; ++i) {
        SpectrumSum sum(0.0);
        for (const EmitterPart& part : s.parts) sum += SpectrumSum((part.*table)[i]);
        sums[i] = Spectrum(sum);
    }
    return sums;
}

double mean_irradiance(const Solution& s, const std::vector<Spectrum>& irradiance) {
    double sum = 0.0, area = 0.0;
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        if (s.coverage[p] == 0.0f) continue;
        const double a = area_of_leaf(s.surface, s.patches, s.patches.leaf_of_patch(p));
        sum += a * luminance(irradiance[p]);
        area += a;
    }
    return area > 0.0 ? sum / area : 0.0;
}

/// Errors of one sign at worst.
double relative_error_of_sum(const EmitterSolution& s) {
    double error = 0.0, sum = 0.0;
    for (const EmitterPart& part : s.parts) {
        const double mean = mean_irradiance(s.all, part.indirect_irradiance);
        error += part.relative_error * mean;
        sum += mean;
    }
    return sum > 0.0 ? error / sum : 0.0;
}

}  // namespace

std::vector<Emitter> emitters_of(const Solution& s) {
    using Kind = Emitter::Kind;
    std::vector<bool> is_used(s.surface.materials.size());
    for (const RootTriangle& t : s.surface.triangles) is_used[t.material] = true;
    std::vector<Emitter> emitters;
    for (std::uint32_t i = 0; i < is_used.size(); ++i)
        if (is_used[i] && s.surface.materials[i].emits())
            add_emitter({s.surface.materials[i].name, Kind::material, i}, emitters);
    for (std::uint32_t i = 0; i < s.lighting.lights.size(); ++i)
        if (max_channel(s.lighting.lights[i].intensity) > 0.0f)
            add_emitter({s.lighting.lights[i].name, Kind::light, i}, emitters);
    if (s.lighting.environment.shines())
        add_emitter({"environment", Kind::environment, 0}, emitters);
    return emitters;
}

void add_up(EmitterSolution& s) {
    Solution& all = s.all;
    const std::size_t patches = all.patches.patch_count();
    all.direct_irradiance = direct_irradiance(all.direct, all.patches.patch_count());
    all.indirect_irradiance = sum_of(s, &EmitterPart::indirect_irradiance, patches);
    all.standard_error = sum_of(s, &EmitterPart::standard_error, patches);
    all.glossy_elements = sum_of(s, &EmitterPart::glossy_elements, all.glossy.element_count);
    all.spatial_error.clear();  // a part's own
    all.directional_error.clear();
    all.balance = {};
    for (const EmitterPart& part : s.parts)
        for (const auto flux : fluxes) all.balance.*flux += part.balance.*flux;
    all.relative_error = relative_error_of_sum(s);
}

void scale_emitter(EmitterSolution& s, const std::string& name, const Spectrum& factor) {
    std::string known;
    EmitterPart* scaled_part = nullptr;
    for (EmitterPart& part : s.parts) {
        known += (known.empty() ? "" : ", ") + part.emitter.name;
        if (part.emitter.name == name) scaled_part = &part;
    }
    if (!scaled_part)
        throw UsageError(fmt::format("emitter '{}'; accepted: one of {}", name, known));
    for (int c = 0; c < channel_count; ++c)
        if (!std::isfinite(factor[c]) || factor[c] < 0.0f)
            throw UsageError(
                fmt::format("emitter '{}': factor {}; accepted: a finite number of at "
                            "least 0",
                            name, factor[c]));
    EmitterPart& part = *scaled_part;
    for (const auto table : tables)
        for (Spectrum& value : part.*table) value *= factor;
    for (const auto flux : fluxes) part.balance.*flux *= SpectrumSum(factor);
    put_colours(s.all, scaled(colours_of(s.all), part.emitter, factor));
    s.all.scene_hash = hash_scene(s.all.surface, s.all.lighting);
    add_up(s);
}

}  // namespace transillum
