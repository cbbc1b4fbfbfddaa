#include <transillum/base/error.h>
#include <transillum/solution/bake.h>
#include <transillum/transport/choose_splits.h>

#include "solution/baker.h"
#include "solution/energy.h"
#include "solution/scene_hash.h"

#include <fmt/format.h>

namespace transillum {

namespace {

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

void note_decisions(const Solution& s, Monitor& monitor) {
    for (const Decision& d : s.decisions) monitor.note(d.what + ": " + d.why);
}

void record_settings(const BakeOptions& o, Solution& s) {
    const char* const shots[] = {"auto", "off", "hemicube", "vectors"};
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
