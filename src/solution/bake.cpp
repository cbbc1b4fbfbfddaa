#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/first_shot/shoot_direct_light.h>
#include <transillum/solution/bake.h>
#include <transillum/transport/choose_splits.h>
#include <transillum/visibility/transillumination_buffer.h>

#include "solution/leaf_colours.h"
#include "solution/memory_estimate.h"
#include "solution/patch_sources.h"
#include "solution/scene_hash.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

constexpr double pixels_a_leaf_edge = 3.0;
constexpr int least_resolution = 256, largest_resolution = 4096;
/// Share of the flux on sharp lobes from which it is worth a word.
constexpr double much_on_sharp_lobes = 0.01;

/// Adds the time since the last lap to the record.
class StopWatch {
public:
    explicit StopWatch(RunRecord* run) : run_(run) {}
    void lap(const char* phase) {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> elapsed = now - last_;
        last_ = now;
        if (!run_) return;
        for (auto& [name, seconds] : run_->seconds)
            if (name == phase) {
                seconds += elapsed.count();
                return;
            }
        run_->seconds.emplace_back(phase, elapsed.count());
    }

private:
    RunRecord* run_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void require_light(const Scene& scene, const SurfaceMesh& mesh) {
    if (!scene.lighting.lights.empty() || scene.lighting.environment.shines()) return;
    for (const RootTriangle& t : mesh.triangles)
        if (mesh.materials[t.material].emits()) return;
    throw InputError(
        scene.path,
        fmt::format("no light: none of the materials of its {} triangles emits; accepted: at "
                    "least one (OBJ: Ke, glTF: emissiveFactor), a light or an environment",
                    mesh.triangles.size()));
}

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

/// Of uniform light, by both lobes.
Spectrum reflected_share(const Solution& s, std::uint32_t patch) {
    const GlossySide* const side = s.glossy_side(patch);
    if (!side) return s.diffuse(patch);
    Brdf brdf = s.glossy.brdfs[side->brdf];
    brdf.diffuse = s.diffuse(patch);
    return mean_albedo(brdf);
}

/// Flux of lights without extent on the surface; what they send past it nobody misses.
SpectrumSum arrived_from_lights(const Solution& s) {
    SpectrumSum sum(0.0);
    const std::size_t n = s.direct.samples.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (s.direct.samples[i].kind == LightSample::Kind::area) continue;
        double share = 0.0;
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p)
            share += area_of_leaf(s.surface, s.patches, s.patches.leaf_of_patch(p)) *
                     s.direct.geometry_factor[p * n + i] * s.direct.visibility[p * n + i];
        sum += share * SpectrumSum(s.direct.samples[i].emitted);
    }
    return sum;
}

EnergyBalance measure_balance(const Solution& s, const TransportResult& transport) {
    EnergyBalance balance;
    balance.escaped = transport.escaped;
    balance.entered = transport.entered;
    SpectrumSum shot(0.0), arrived(0.0);
    for (const LightSample& l : s.direct.samples)
        shot += SpectrumSum(l.emitted) * (std::numbers::pi * l.area);
    const SpectrumSum by_lights = arrived_from_lights(s);
    balance.entered += by_lights;
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        const double area = area_of_leaf(s.surface, s.patches, s.patches.leaf_of_patch(p));
        const SpectrumSum direct = area * SpectrumSum(s.direct_irradiance[p]);
        const SpectrumSum flux = direct + area * SpectrumSum(s.indirect_irradiance[p]);
        arrived += direct;
        balance.emitted += area * std::numbers::pi * SpectrumSum(s.emission(p));
        const SpectrumSum reflected(s.direct_radiance(p) + s.finite_element_radiance(p));
        if (s.reflects(p))
            balance.absorbed += flux - area * std::numbers::pi * reflected;
        else
            balance.black_backs += flux;
    }
    balance.escaped += glm::max(shot - (arrived - by_lights), SpectrumSum(0.0));
    return balance;
}

void decide_first_shot(const Luminaires& luminaires, FirstShot choice,
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

void note_decisions(const Solution& s, Monitor& monitor) {
    for (const Decision& d : s.decisions) monitor.note(d.what + ": " + d.why);
}

/// Light that meets lobes sharper than the bins can hold is blurred on its way to other surfaces:
/// pictures of mirrors are none the worse, caustics are.
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

void record_settings(const BakeOptions& o, Solution& s) {
    const char* const shots[] = {"auto", "off", "hemicube"};
    s.settings = {
        {"patch-size", fmt::format("{}", o.subdivision.patch_size)},
        {"leaves", fmt::format("{}", o.subdivision.leaf_target)},
        {"max-level", fmt::format("{}", o.subdivision.max_level)},
        {"crease-angle", fmt::format("{}", o.surface.crease_angle)},
        {"first-shot", shots[static_cast<int>(o.light.first_shot)]},
        {"light-samples", fmt::format("{}", o.light.samples)},
        {"hemicube", fmt::format("{}", o.hemicube_resolution)},
        {"resolution", fmt::format("{}", o.resolution)},
        {"iterations", fmt::format("{}", o.iteration.iterations)},
        {"target-error", fmt::format("{}", o.iteration.target_error)},
        {"time", fmt::format("{}", o.iteration.seconds)},
        {"averaging", o.iteration.averaging == Averaging::paper ? "paper" : "balanced"},
        {"brdf-bins", o.bins.level < 0 ? "auto" : fmt::format("{}", bin_count(o.bins.level))},
        {"seed", fmt::format("{}", o.seed)}};
}

/// From a surface and its patches to radiance: the first shot and the iteration.
class Baker {
public:
    Baker(const BakeOptions& options, const Workers& workers, Monitor& monitor, StopWatch& watch)
        : options_(options), workers_(workers), monitor_(monitor), watch_(watch) {}

    /// Of a solution that has its surface, patches and lighting.
    void run(Solution& s, std::uint64_t iterations) const {
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

private:
    void shoot(Solution& s) const {
        LightSampleOptions light = options_.light;
        light.seed = options_.seed;
        const Luminaires luminaires = sample_luminaires(s.surface, light, s.lighting.lights);
        decide_first_shot(luminaires, light.first_shot, s.decisions);
        require_memory(estimate_memory(s, luminaires.samples.size(), workers_.count()),
                       options_.memory);
        s.direct = shoot_direct_light(s.surface, s.patches, luminaires,
                                      options_.hemicube_resolution, workers_, monitor_);
        s.direct_irradiance = direct_irradiance(s.direct, s.patches.patch_count());
        s.interrupted = monitor_.stop_requested();
    }

    void iterate_on(Solution& s, std::uint64_t iterations) const {
        IterationOptions iteration = options_.iteration;
        iteration.iterations = iterations;
        iteration.seed = options_.seed;
        iteration.pixel_size = options_.resolution > 0
                                   ? pixel_size_for(s.surface, options_.resolution)
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

    const BakeOptions& options_;
    const Workers& workers_;
    Monitor& monitor_;
    StopWatch& watch_;
};

/// Directions of the first phase: enough for every patch to be met from all around.
constexpr std::uint64_t first_phase = 64;

SplitChoice find_coarse_leaves(const Solution& s, const PatchHierarchy& patches,
                               const SplitPatches& children, const RefinementOptions& refinement,
                               const SplitOptions& options) {
    std::vector<Spectrum> radiance, direct;
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        radiance.push_back(s.finite_element_radiance(p));
        if (refinement.direct) direct.push_back(s.direct_radiance(p));
    }
    return choose_splits(s.surface, patches, children, radiance, s.standard_error, direct, options);
}

/// Splits the patches of `s`, which has no radiance yet, where it is going to vary.
Decision refine(Solution& s, const BakeOptions& options, const Baker& baker, Monitor& monitor) {
    const std::uint32_t before = s.patches.leaf_count;
    SplitOptions split{options.refinement.tolerance, options.refinement.max_leaves,
                       options.subdivision.max_level};
    if (split.max_leaves == 0) split.max_leaves = 4 * before;
    int phase = 0;
    bool limited = false;
    std::uint64_t directions = first_phase;
    for (; phase < options.refinement.phases && !monitor.stop_requested(); ++phase) {
        Solution trial = s;
        const SplitPatches children = split_all_leaves(s.patches);
        trial.patches = children.patches;
        baker.run(trial, std::min(directions, options.iteration.iterations));
        if (options.refinement.keep_phase) options.refinement.keep_phase(trial, phase);
        const SplitChoice choice =
            find_coarse_leaves(trial, s.patches, children, options.refinement, split);
        monitor.note(fmt::format("phase {}: {} of {} leaves split", phase + 1, choice.count,
                                 s.patches.leaf_count));
        limited = choice.limited;
        if (choice.count == 0) break;
        s.patches = split_leaves(s.patches, choice.split).patches;
        directions *= 2;
    }
    return {
        fmt::format("{} leaves refined to {} in {} phases", before, s.patches.leaf_count, phase),
        limited ? "as many as allowed" : "until the tolerance was met, or the phases were over"};
}

}  // namespace

Solution bake(const Scene& scene, const BakeOptions& options, const Workers& workers,
              Monitor& monitor, RunRecord* run) {
    StopWatch watch(run);
    Solution s;
    s.seed = options.seed;
    s.cameras = scene.cameras;
    s.lighting = scene.lighting;
    record_settings(options, s);
    s.surface = build_surface(scene, options.surface, monitor);
    require_light(scene, s.surface);
    s.patches = subdivide_uniformly(s.surface, options.subdivision);
    s.scene_hash = hash_scene(s.surface, s.lighting);
    watch.lap("geometry");

    const Baker baker(options, workers, monitor, watch);
    std::vector<Decision> refined;
    if (options.refinement.phases > 0) refined.push_back(refine(s, options, baker, monitor));
    baker.run(s, options.iteration.iterations);
    s.decisions.insert(s.decisions.begin(), refined.begin(), refined.end());
    warn_of_sharp_lobes(s, monitor);
    note_decisions(s, monitor);
    if (run) run->threads = workers.count();
    return s;
}

}  // namespace transillum
