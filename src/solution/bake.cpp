#include <transillum/base/error.h>
#include <transillum/solution/bake.h>
#include <transillum/transport/choose_bins.h>
#include <transillum/transport/choose_splits.h>

#include "solution/baker.h"
#include "solution/energy.h"
#include "solution/scene_hash.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace transillum {

namespace {

/// \param faces the scene's polygons, or the triangles that are left of them
template <class Faces>
void require_light(const Scene& scene, const Faces& faces) {
    if (!scene.lighting.lights.empty() || scene.lighting.environment.shines()) return;
    for (const auto& face : faces)
        if (scene.materials[face.material].emits()) return;
    throw InputError(
        scene.path,
        fmt::format("no light: none of the materials of its {} faces emits; accepted: at least "
                    "one (OBJ: Ke, glTF: emissiveFactor), a light or an environment",
                    faces.size()));
}

void note_decisions(const Solution& s, Monitor& monitor) {
    for (const Decision& d : s.decisions) monitor.note(d.what + ": " + d.why);
}

std::vector<std::pair<std::string, std::string>> settings_of(const BakeOptions& o) {
    const char* const shots[] = {"auto", "off", "hemicube", "vectors"};
    const char* const averagings[] = {"balanced", "paper", "none"};
    const char* const residuals[] = {"auto", "off", "subpatch", "wavefront"};
    const char* const repairs[] = {"off", "safe", "full"};
    return {{"repair", repairs[static_cast<int>(o.repair.level)]},
            {"repair-tolerance", fmt::format("{}", o.repair.tolerance)},
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
            {"monte-carlo", residuals[static_cast<int>(o.iteration.monte_carlo)]},
            {"refine", fmt::format("{}", o.refinement.phases)},
            {"refine-tolerance", fmt::format("{}", o.refinement.tolerance)},
            {"max-leaves", fmt::format("{}", o.refinement.max_leaves)},
            {"refine-for", o.refinement.direct ? "stored" : "traced"},
            {"dark-rooms", o.dark_rooms == DarkRooms::automatic ? "auto" : "keep"},
            {"averaging", averagings[static_cast<int>(o.iteration.averaging)]},
            {"brdf-bins", o.bins.level < 0 ? "auto" : fmt::format("{}", bin_count(o.bins.level))},
            {"seed", fmt::format("{}", o.seed)}};
}

/// Directions of the first phase: enough for every patch to be met from all around, and to tell its
/// light from noise.
constexpr std::uint64_t first_phase = 128;
constexpr std::uint64_t all_directions = std::numeric_limits<std::uint64_t>::max();

/// Bins of automatic levels are divided as the light asks for it, from one level above what the
/// lobe alone would, where some phase is going to try that one.
std::vector<std::int8_t> first_bin_levels(const Solution& s, const BakeOptions& options) {
    std::vector<std::int8_t> levels = choose_bin_levels(s.surface, options.bins);
    if (options.refinement.phases == 0 || options.bins.level >= 0) return levels;
    std::vector<std::int8_t> fewer = levels;
    for (std::int8_t& level : fewer)
        if (level > 0) --level;
    const std::vector<std::int8_t> tried =
        deeper_bins(fewer, first_phase << (options.refinement.phases - 1));
    for (std::size_t i = 0; i < levels.size(); ++i)
        if (tried[i] >= levels[i]) levels[i] = fewer[i];
    return levels;
}

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

/// Divides the bins where the radiance of a phase asks for it. Patches split where it ranges over
/// more than the tolerance; what is spread evenly over that range deviates by this share of it.
constexpr double deviation_of_range = 0.288675;  // 1 / sqrt(12)

std::uint32_t divide_bins(const Solution& phase, double tolerance, Refined& refined) {
    std::vector<Spectrum> radiance;
    for (std::uint32_t p = 0; p < phase.patches.patch_count(); ++p)
        radiance.push_back(phase.finite_element_radiance(p));
    BinChoice choice = choose_bins(
        refined.bin_levels, phase.surface, phase.patches, phase.glossy, phase.glossy_elements,
        deviation_of_range * tolerance * mean_luminance(phase.surface, phase.patches, radiance));
    refined.bin_levels = std::move(choice.levels);
    return choice.divided;
}

/// Splits the patches of `s`, which has no radiance yet, and divides their bins, where it is going
/// to vary.
Decision refine(Solution& s, const BakeOptions& options, const Baker& baker, Monitor& monitor,
                Refined& refined) {
    const std::uint32_t before = s.patches.leaf_count;
    SplitOptions split{options.refinement.tolerance, options.refinement.max_leaves,
                       options.subdivision.max_level};
    if (split.max_leaves == 0) split.max_leaves = 4 * before;
    int phase = 0;
    bool limited = false;
    const bool divides = options.bins.level < 0;
    for (; phase < options.refinement.phases && !monitor.stop_requested(); ++phase) {
        Solution trial = s;
        const SplitPatches children = split_all_leaves(s.patches);
        trial.patches = children.patches;
        refined.directions = std::max(first_phase, 2 * refined.directions);
        Refined tried = refined;
        const std::vector<std::int8_t> before_dividing = refined.bin_levels;
        if (divides) tried.bin_levels = deeper_bins(refined.bin_levels, refined.directions);
        refined.sums = baker.run(trial, tried, refined.directions, true);
        if (options.refinement.keep_phase) options.refinement.keep_phase(trial, phase);
        const SplitChoice choice =
            find_coarse_leaves(trial, s.patches, children, options.refinement, split);
        const std::uint32_t divided =
            divides ? divide_bins(trial, options.refinement.tolerance, refined) : 0;
        monitor.note(fmt::format("phase {}: {} of {} leaves split, bins of {} glossy sides divided",
                                 phase + 1, choice.count, s.patches.leaf_count, divided));
        limited = choice.limited;
        const bool all_tried =
            !divides || tried.bin_levels == deeper_bins(before_dividing, all_directions);
        if (choice.count == 0 && divided == 0 && all_tried) break;
        s.patches = split_leaves(s.patches, choice.split).patches;
    }
    return {
        fmt::format("{} leaves refined to {} in {} phases", before, s.patches.leaf_count, phase),
        limited ? "as many as allowed" : "until the tolerance was met, or the phases were over"};
}

/// Refinement and sub-patches try quarters of all leaves.
void require_room_for_quarters(const BakeOptions& o) {
    const bool splits = o.refinement.phases > 0 || o.iteration.monte_carlo != MonteCarlo::off ||
                        o.iteration.averaging == Averaging::none;
    if (splits && o.subdivision.max_level >= max_subdivision_level)
        throw UsageError(fmt::format(
            "max level {}: refinement and the Monte-Carlo component look at quarters of leaves; "
            "accepted with them: at most {}",
            o.subdivision.max_level, max_subdivision_level - 1));
}

/// What was done to the meshes, or why nothing was.
std::vector<Decision> decisions_about(const RepairReport& report, RepairLevel level,
                                      const SnapGrid& grid) {
    std::string done;
    for (const RepairStep& step : report.steps)
        done += fmt::format("{}{} {}", done.empty() ? "" : ", ", step.what, step.count);
    const char* const nothing = level == RepairLevel::safe ? "a safe one would find nothing to do"
                                                           : "it would find nothing to do";
    return {level == RepairLevel::off ? Decision{"no repair", "--repair off"}
            : done.empty()            ? Decision{"no repair", nothing}
                                      : Decision{"meshes repaired", done},
            {fmt::format("vertices snapped to a grid of {:.3g}, by up to {:.3g}",
                         std::ldexp(1.0, grid.exponent), grid.largest_move),
             "the corners of all patches are then exact"}};
}

}  // namespace

RepairedScene make_sound(const Scene& scene, RepairOptions options, const Workers& workers,
                         Monitor& monitor) {
    require_light(scene, scene.polygons);  // before the work
    options.rounding = Rounding::dyadic;
    RepairedScene repaired = repair_scene(scene, options, workers, monitor);
    for (const std::string& left : repaired.report.left)
        monitor.warn(fmt::format("{}: not repaired: {}", scene.path, left));
    return repaired;
}

Layout lay_out_solution(RepairedScene sound, const BakeOptions& options, const Baker& baker,
                        StopWatch& watch, Monitor& monitor) {
    Scene& scene = sound.scene;
    require_room_for_quarters(options);
    Layout layout;
    Solution& s = layout.solution;
    s.seed = options.seed;
    s.cameras = scene.cameras;
    s.lighting = scene.lighting;
    s.settings = settings_of(options);
    s.surface = build_surface(scene, options.surface, monitor);
    SnapGrid& grid = s.surface.grid;
    grid.largest_move = std::max(grid.largest_move, sound.report.snapped_by);
    layout.decisions = decisions_about(sound.report, options.repair.level, grid);
    require_light(scene, s.surface.triangles);
    scene = {};  // the surface has all that is wanted of it
    s.patches = subdivide_uniformly(s.surface, options.subdivision);
    s.scene_hash = hash_scene(s.surface, s.lighting);
    watch.lap("geometry");
    layout.refined.bin_levels = first_bin_levels(s, options);
    if (options.refinement.phases > 0)
        layout.decisions.push_back(refine(s, options, baker, monitor, layout.refined));
    return layout;
}

std::string hash_input(const Scene& scene, const BakeOptions& options) {
    auto settings = settings_of(options);
    settings.emplace_back("keep-sums", options.iteration.keep_sums ? "on" : "off");
    return hash_input(scene, settings);
}

Solution bake(const Scene& scene, const BakeOptions& options, const Workers& workers,
              Monitor& monitor, RunRecord* run) {
    StopWatch watch(run);
    const Baker baker(options, workers, monitor, watch);
    RepairedScene sound = make_sound(scene, options.repair, workers, monitor);
    watch.lap("repair");
    Layout layout = lay_out_solution(std::move(sound), options, baker, watch, monitor);
    Solution& s = layout.solution;
    // As many again as the phases took: what they inherited from larger patches must fade.
    const std::uint64_t least = 2 * layout.refined.directions;
    if (options.iteration.iterations < least)
        layout.decisions.push_back(
            {fmt::format("{} directions, not {}", least, options.iteration.iterations),
             "the phases took half as many"});
    baker.prepare(s, layout.refined.bin_levels);
    const bool shot_is_whole = !s.interrupted;
    const auto sums =
        baker.transport(s, std::max(options.iteration.iterations, least), layout.refined.sums,
                        options.iteration.keep_sums && shot_is_whole);
    if (sums)
        s.continuation = std::make_shared<Continuation>(Continuation{sums, measure_first_shot(s)});
    s.decisions.insert(s.decisions.begin(), layout.decisions.begin(), layout.decisions.end());
    warn_of_sharp_lobes(s, monitor);
    note_decisions(s, monitor);
    if (run) {
        run->threads = workers.count();
        run->input_hash = hash_input(scene, options);
    }
    return std::move(s);
}

}  // namespace transillum
