#include "solution/baker.h"

#include <transillum/solution/patch_sources.h>
#include "solution/energy.h"
#include "solution/leaf_colours.h"
#include "solution/memory_estimate.h"

#include <transillum/first_shot/shoot_direct_light.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

double mebibytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) * 0x1p-20;
}

std::uint64_t table_bytes(const DirectLight& direct) {
    return (direct.geometry_factor.size() + direct.visibility.size()) * sizeof(float) +
           direct.vectors.size() * sizeof(glm::vec3);
}

void decide_first_shot(const Luminaires& luminaires, FirstShot choice, std::uint32_t patches,
                       std::vector<Decision>& decisions) {
    const char* const why =
        choice == FirstShot::automatic ? "a small part of the scene's surface" : "asked for";
    if (luminaires.shot > 0)
        decisions.push_back(
            {fmt::format("first shot: {} of {} luminaires, {} light samples", luminaires.shot,
                         luminaires.count, luminaires.samples.size()),
             why});
    else
        decisions.push_back(
            {"no first shot", choice == FirstShot::off
                                  ? "asked for"
                                  : fmt::format("every luminaire is large (up to {:.0f} % of the "
                                                "surface): cheaper in the iteration",
                                                100.0 * luminaires.largest_share)});
    if (luminaires.first_samples.empty()) return;
    const std::size_t vectors = luminaires.first_samples.size();
    decisions.push_back(
        {fmt::format("{} light vector{} a patch, {:.1f} MiB", vectors, vectors == 1 ? "" : "s",
                     mebibytes(light_vector_bytes(vectors, patches))),
         fmt::format("asked for; all samples would take {:.1f} MiB",
                     mebibytes(sample_table_bytes(luminaires.samples.size(), patches)))});
}

/// How many direction bins patches have, and what they can't hold.
void decide_bins(const Solution& s, const BakeOptions& options, std::vector<Decision>& decisions) {
    if (s.glossy.empty()) {
        decisions.push_back({"one direction bin a patch", "no surface has a glossy lobe"});
        return;
    }
    std::uint64_t patches = 0, bins = 0;
    for (const GlossySide& side : s.glossy.sides) {
        patches += side.leaf_count;
        bins += std::uint64_t{side.leaf_count} * bin_count(side.bin_level);
    }
    decisions.push_back(
        {fmt::format("{} direction bins on {} glossy patches, one on all others", bins, patches),
         options.bins.level >= 0         ? "asked for"
         : options.refinement.phases > 0 ? "as the light on them asks for"
                                         : "by the width and weight of their lobes"});
}

/// A bake that goes on comes to most decisions again.
void decide_once(const Decision& decision, std::vector<Decision>& decisions) {
    if (std::ranges::find(decisions, decision.what, &Decision::what) == decisions.end())
        decisions.push_back(decision);
}

void decide_monte_carlo(const TransportResult& t, MonteCarlo choice, Averaging averaging,
                        std::vector<Decision>& decisions) {
    std::erase_if(decisions, [](const Decision& d) {
        return d.what.find("Monte-Carlo component") != std::string::npos;
    });
    if (t.carried == 0) {
        decisions.push_back({"no Monte-Carlo component in the transport",
                             choice == MonteCarlo::off ? "asked for" : "too few directions"});
        return;
    }
    const char* const how = t.monte_carlo == MonteCarlo::subpatch
                                ? "on the quarters of patches"
                                : "in the transillumination buffer";
    const std::string what = fmt::format("Monte-Carlo component carried {} for {} of {} directions",
                                         how, t.carried, t.iterations);
    std::string why;
    if (averaging == Averaging::none)
        why = "plain iteration: no finite elements are fed back";
    else if (choice != MonteCarlo::automatic)
        why = "asked for";
    else if (std::isnan(t.residual_effect))
        why = "too few directions to tell what it is worth";
    else
        why =
            fmt::format("it changes {:.2g} % of what patches receive, {} the error to be expected",
                        100.0 * t.residual_effect, t.carried_to_the_end ? "above" : "below");
    if (t.carried_anew_at > 0)
        why += fmt::format("; begun anew at {} directions, as what is carried is not stored",
                           t.carried_anew_at);
    decisions.push_back({what, why});
}

}  // namespace

std::shared_ptr<const IterationSums> Baker::run(Solution& s, const Refined& refined,
                                                std::uint64_t iterations, bool keep_sums) const {
    prepare(s, refined.bin_levels);
    return transport(s, iterations, refined.sums, keep_sums);
}

void Baker::prepare(Solution& s, std::span<const std::int8_t> bin_levels) const {
    s.decisions.clear();
    s.glossy = lay_out_glossy_sides(s.surface, s.patches, bin_levels);
    decide_bins(s, options_, s.decisions);
    average_textures(s);
    shoot(s);
    watch_.lap("first shot");
}

std::shared_ptr<const IterationSums> Baker::transport(Solution& s, std::uint64_t iterations,
                                                      std::shared_ptr<const IterationSums> start,
                                                      bool keep_sums) const {
    auto sums = iterate_on(s, iterations, std::move(start), keep_sums);
    watch_.lap("transport");
    return sums;
}

double Baker::pixel_size(const Solution& s) const {
    if (goes_on_from) return options_.iteration.pixel_size;
    return options_.resolution > 0 ? pixel_size_for(s.surface, options_.resolution)
                                   : automatic_pixel_size(s.surface, s.patches);
}

void Baker::require_room(const Solution& s, const Luminaires& luminaires) const {
    MemoryEstimate needed = estimate_memory(s, luminaires, workers_.count(), band_groups);
    needed.monte_carlo =
        monte_carlo_bytes(carried_by(options_.iteration.monte_carlo, options_.iteration.averaging),
                          s.surface, s.patches, pixel_size(s), workers_.count());
    if (goes_on_from) needed.first_shot = table_bytes(s.direct);
    if (options_.iteration.keep_sums) needed.kept_sums = kept_sums_bytes(s);
    require_memory(needed, options_.memory);
}

void Baker::shoot(Solution& s) const {
    LightSampleOptions light = options_.light;
    light.seed = options_.seed;
    const Luminaires luminaires = sample_luminaires(s.surface, light, s.lighting.lights);
    decide_first_shot(luminaires, light.first_shot, s.patches.patch_count(), s.decisions);
    require_room(s, luminaires);
    s.direct = shoot_direct_light(s.surface, s.patches, luminaires, options_.hemicube_resolution,
                                  workers_, monitor_);
    s.direct_irradiance = direct_irradiance(s.direct, s.patches.patch_count());
    s.interrupted = monitor_.stop_requested();
}

std::shared_ptr<const IterationSums> Baker::iterate_on(Solution& s, std::uint64_t iterations,
                                                       std::shared_ptr<const IterationSums> start,
                                                       bool keep_sums) const {
    IterationOptions iteration = options_.iteration;
    iteration.iterations = iterations;
    iteration.seed = options_.seed;
    iteration.start = std::move(start);
    iteration.keep_sums = keep_sums;
    iteration.pixel_size = pixel_size(s);
    const PatchSources sources = make_sources(s);
    if (!shines(sources)) {
        iteration.iterations = 0;
        decide_once({"no iteration", "no surface reflects the direct light"}, s.decisions);
    }
    if (!s.lighting.environment.shines())
        decide_once({"no environment", "the scene has none"}, s.decisions);
    TransportResult transport =
        iterate(s.surface, s.patches, sources, iteration, workers_, monitor_);
    decide_monte_carlo(transport, iteration.monte_carlo, iteration.averaging, s.decisions);
    s.indirect_irradiance = std::move(transport.irradiance);
    // One that had given up carrying what tells of them keeps what it had.
    if (!goes_on_from || !transport.spatial_error.empty()) {
        s.spatial_error = std::move(transport.spatial_error);
        s.directional_error = std::move(transport.directional_error);
    }
    s.coverage = std::move(transport.coverage);
    s.standard_error = std::move(transport.standard_error);
    s.glossy_elements = std::move(transport.glossy_elements);
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p)
        s.standard_error[p] *= reflected_share(s, p) / static_cast<float>(std::numbers::pi);
    s.iterations = transport.iterations;
    s.relative_error = transport.relative_error;
    s.interrupted = s.interrupted || transport.interrupted;
    s.balance = measure_balance(s, goes_on_from ? goes_on_from->first_shot : measure_first_shot(s),
                                transport);
    return transport.sums;
}

}  // namespace transillum
