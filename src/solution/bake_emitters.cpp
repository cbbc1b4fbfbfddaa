#include <transillum/solution/bake_emitters.h>

#include "solution/baker.h"
#include "solution/emitter_colours.h"
#include "solution/energy.h"
#include "solution/group_colours.h"

#include <transillum/base/part_monitor.h>
#include <transillum/first_shot/shoot_direct_light.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace transillum {

namespace {

EmitterPart take_part(Solution& s, Emitter emitter) {
    return {std::move(emitter),
            std::move(s.indirect_irradiance),
            std::move(s.standard_error),
            std::move(s.glossy_elements),
            s.relative_error,
            s.balance};
}

/// Emitters decide alike but where something was measured.
void add_new(std::vector<Decision>& decisions, const std::vector<Decision>& of_part,
             const std::string& name) {
    for (const Decision& d : of_part)
        if (std::ranges::none_of(decisions, [&](const Decision& k) { return k.what == d.what; }))
            decisions.push_back({name.empty() ? d.what : name + ": " + d.what, d.why});
}

}  // namespace

EmitterSolution bake_emitters(const Scene& scene, const BakeOptions& options,
                              const Workers& workers, Monitor& monitor, RunRecord* run) {
    StopWatch watch(run);
    RepairedScene sound = make_sound(scene, options.repair, workers, monitor);
    watch.lap("repair");
    BakeOptions of_part = options;
    of_part.iteration.keep_sums = false;  // nothing goes on from a part's
    Baker baker(of_part, workers, monitor, watch);
    Layout layout = lay_out_solution(std::move(sound), of_part, baker, watch, monitor);
    Solution& s = layout.solution;
    const std::vector<Emitter> emitters = emitters_of(s);
    of_part.iteration.seconds /= static_cast<double>(emitters.size());
    baker.band_groups = emitters.size();
    baker.prepare(s, layout.refined.bin_levels);
    std::vector<Decision>& decisions = layout.decisions;
    decisions.push_back(
        {fmt::format("{} emitters, each transported alone", emitters.size()), "asked for"});
    add_new(decisions, s.decisions, {});

    EmitterSolution result;
    const Colours colours = colours_of(s);
    std::uint64_t iterations = 0;
    for (const Emitter& emitter : emitters) {
        PartMonitor part(monitor, emitter.name);
        put_colours(s, only(colours, emitter));
        s.direct_irradiance = direct_irradiance(s.direct, s.patches.patch_count());
        s.decisions.clear();
        Baker(of_part, workers, part, watch).transport(s, options.iteration.iterations);
        add_new(decisions, s.decisions, emitters.size() == 1 ? std::string() : emitter.name);
        iterations = std::max(iterations, s.iterations);
        result.parts.push_back(take_part(s, emitter));
    }
    put_colours(s, colours);
    s.iterations = iterations;
    s.settings.emplace_back("keep-emitters", "on");
    s.decisions = std::move(decisions);
    result.all = std::move(s);
    add_up(result);
    warn_of_sharp_lobes(result.all, monitor);
    for (const Decision& d : result.all.decisions) monitor.note(d.what + ": " + d.why);
    if (result.all.interrupted)
        monitor.warn(
            "interrupted: emitters have different numbers of iterations, some none: their light "
            "is off");
    if (run) run->threads = workers.count();
    return result;
}

}  // namespace transillum
