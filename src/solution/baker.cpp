#include "solution/baker.h"

#include "solution/energy.h"
#include "solution/leaf_colours.h"
#include "solution/memory_estimate.h"
#include "solution/patch_sources.h"

#include <transillum/first_shot/shoot_direct_light.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace transillum {

namespace {

constexpr double pixels_a_leaf_edge = 3.0;
constexpr int least_resolution = 256, largest_resolution = 4096;

/// So many pixels that an average leaf (by area) is three wide.
double automatic_pixel_size(const SurfaceMesh& mesh, const PatchHierarchy& patches) {
    double area = 0.0, weighted_edge = 0.0;
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
        const double a = area_of_leaf(mesh, patches, leaf);
        area += a;
        weighted_edge += a * std::sqrt(2.0 * a);
    }
    const double wanted = weighted_edge / area / pixels_a_leaf_edge;
    return std::clamp(wanted, pixel_size_for(mesh, largest_resolution),
                      pixel_size_for(mesh, least_resolution));
}

double mebibytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) * 0x1p-20;
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
void decide_bins(const Solution& s, const BinOptions& options, std::vector<Decision>& decisions) {
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
         options.level < 0 ? "by the width and weight of their lobes" : "asked for"});
}

}  // namespace

void Baker::run(Solution& s, std::uint64_t iterations) const {
    s.decisions.clear();
    s.glossy =
        lay_out_glossy_sides(s.surface, s.patches, choose_bin_levels(s.surface, options_.bins));
    decide_bins(s, options_.bins, s.decisions);
    average_textures(s);
    shoot(s);
    watch_.lap("first shot");
    iterate_on(s, iterations);
    watch_.lap("transport");
}

void Baker::shoot(Solution& s) const {
    LightSampleOptions light = options_.light;
    light.seed = options_.seed;
    const Luminaires luminaires = sample_luminaires(s.surface, light, s.lighting.lights);
    decide_first_shot(luminaires, light.first_shot, s.patches.patch_count(), s.decisions);
    require_memory(estimate_memory(s, luminaires, workers_.count()), options_.memory);
    s.direct = shoot_direct_light(s.surface, s.patches, luminaires, options_.hemicube_resolution,
                                  workers_, monitor_);
    s.direct_irradiance = direct_irradiance(s.direct, s.patches.patch_count());
    s.interrupted = monitor_.stop_requested();
}

void Baker::iterate_on(Solution& s, std::uint64_t iterations) const {
    IterationOptions iteration = options_.iteration;
    iteration.iterations = iterations;
    iteration.seed = options_.seed;
    iteration.pixel_size = options_.resolution > 0 ? pixel_size_for(s.surface, options_.resolution)
                                                   : automatic_pixel_size(s.surface, s.patches);
    const PatchSources sources = make_sources(s);
    if (!shines(sources)) {
        iteration.iterations = 0;
        s.decisions.push_back({"no iteration", "no surface reflects the direct light"});
    }
    if (!s.lighting.environment.shines())
        s.decisions.push_back({"no environment", "the scene has none"});
    TransportResult transport =
        iterate(s.surface, s.patches, sources, iteration, workers_, monitor_);
    s.indirect_irradiance = std::move(transport.irradiance);
    s.coverage = std::move(transport.coverage);
    s.standard_error = std::move(transport.standard_error);
    s.glossy_elements = std::move(transport.glossy_elements);
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p)
        s.standard_error[p] *= reflected_share(s, p) / static_cast<float>(std::numbers::pi);
    s.iterations = transport.iterations;
    s.relative_error = transport.relative_error;
    s.interrupted = s.interrupted || transport.interrupted;
    s.balance = measure_balance(s, transport);
}

}  // namespace transillum
