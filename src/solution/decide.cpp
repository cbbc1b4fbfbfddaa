#include "solution/decide.h"

#include <transillum/visibility/transillumination_buffer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace transillum {

namespace {

double mebibytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) * 0x1p-20;
}

/// A bake that goes on comes to most decisions again.
void decide_once(const Decision& decision, std::vector<Decision>& decisions) {
    if (std::ranges::find(decisions, decision.what, &Decision::what) == decisions.end())
        decisions.push_back(decision);
}

/// What the transport comes to, which one that goes on decides anew.
constexpr const char* of_transport[] = {"Monte-Carlo component", "left out of the transport",
                                        "directions transferred"};

void decide_monte_carlo(const TransportResult& t, MonteCarlo choice, Averaging averaging,
                        std::vector<Decision>& decisions) {
    if (t.carried == 0) {
        decisions.push_back(
            {"no Monte-Carlo component in the transport",
             choice == MonteCarlo::off ? "off, as asked for or by default" : "too few directions"});
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

void decide_stop(const TransportResult& t, const IterationOptions& options,
                 std::vector<Decision>& decisions) {
    const bool is_cut_short = t.iterations < options.iterations;
    if (t.interrupted || (!is_cut_short && options.target_error <= 0.0)) return;
    // Time may stop it with the error met, too.
    const bool is_met =
        options.target_error > 0.0 &&
        (options.seconds > 0.0 ? t.relative_error <= options.target_error : is_cut_short);
    const std::string error = fmt::format("{:.2g} % is estimated", 100.0 * t.relative_error);
    decisions.push_back({fmt::format("{} directions transferred", t.iterations),
                         is_met ? "the error asked for is met: " + error
                         : is_cut_short
                             ? "the time is over: " + error
                             : "as many as allowed, before the error asked for is met: " + error});
}

}  // namespace

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

void decide_black(const Solution& s, std::vector<Decision>& decisions) {
    std::uint64_t black = 0;
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        const Material& m = s.material_of(p);
        const bool is_black = max_channel(m.diffuse) == 0.0f && max_channel(m.specular) == 0.0f;
        if ((!s.reflects(p) || is_black) && !s.emits(p)) ++black;
    }
    if (black > 0)
        decisions.push_back({fmt::format("{} of {} patches receive for the energy balance alone",
                                         black, s.patches.patch_count()),
                             "black: they neither reflect nor emit"});
}

void decide_textures(const Solution& s, std::vector<Decision>& decisions) {
    if (s.leaf_diffuse.empty() && s.leaf_emission.empty())
        decisions.push_back({"no texture is averaged",
                             "no material in use has one of its diffuse part or emission"});
}

void decide_light(const Solution& s, bool is_lit, std::vector<Decision>& decisions) {
    if (!is_lit) decide_once({"no iteration", "no surface reflects the direct light"}, decisions);
    if (!s.lighting.environment.shines())
        decide_once({"no environment", "the scene has none"}, decisions);
}

void decide_resolution(const Solution& s, double pixel_size, int asked_for,
                       std::vector<Decision>& decisions) {
    constexpr int unit = 1000;
    const double across = unit * pixel_size_for(s.surface, unit) / pixel_size;
    decide_once({fmt::format("transillumination buffer about {:.0f} pixels across", across),
                 asked_for > 0 ? "asked for" : "three a leaf's edge, between 256 and 4096"},
                decisions);
}

void decide_transport(const TransportResult& transport, const DarkRoots& dark,
                      const IterationOptions& options, std::vector<Decision>& decisions) {
    std::erase_if(decisions, [](const Decision& d) {
        return std::ranges::any_of(
            of_transport, [&](const char* part) { return d.what.find(part) != std::string::npos; });
    });
    if (!dark.empty())
        decisions.push_back(
            {fmt::format("{} of {} triangles, {:.0f} % of the surface, left out of the transport",
                         dark.count, dark.is_dark.size(), 100.0 * dark.surface),
             fmt::format("no light reaches them along {} directions", dark.directions)});
    decide_monte_carlo(transport, options.monte_carlo, options.averaging, decisions);
    decide_stop(transport, options, decisions);
}

}  // namespace transillum
