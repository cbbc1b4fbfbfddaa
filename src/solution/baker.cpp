#include "solution/baker.h"

#include <transillum/solution/patch_sources.h>
#include "solution/decide.h"
#include "solution/energy.h"
#include "solution/leaf_colours.h"
#include "solution/memory_estimate.h"

#include <transillum/first_shot/shoot_direct_light.h>
#include <transillum/transport/find_dark_roots.h>
#include <transillum/transport/iterate_without.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <numbers>

namespace transillum {

namespace {

std::uint64_t table_bytes(const DirectLight& direct) {
    return (direct.geometry_factor.size() + direct.visibility.size()) * sizeof(float) +
           direct.vectors.size() * sizeof(glm::vec3);
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
    decide_black(s, s.decisions);
    average_textures(s);
    decide_textures(s, s.decisions);
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
    const bool is_lit = shines(sources);
    if (!is_lit) iteration.iterations = 0;
    decide_light(s, is_lit, s.decisions);
    decide_resolution(s, iteration.pixel_size, options_.resolution, s.decisions);
    DarkRoots dark;
    if (is_lit && options_.dark_rooms == DarkRooms::automatic)
        dark = find_dark_roots(s.surface, s.patches, sources, iteration, workers_, monitor_);
    TransportResult transport =
        dark.empty() ? iterate(s.surface, s.patches, sources, iteration, workers_, monitor_)
                     : iterate_without(dark.is_dark, s.surface, s.patches, sources, iteration,
                                       workers_, monitor_);
    decide_transport(transport, dark, iteration, s.decisions);
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
