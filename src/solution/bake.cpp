#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/first_shot/shoot_direct_light.h>
#include <transillum/solution/bake.h>
#include <transillum/visibility/transillumination_buffer.h>

#include "solution/patch_sources.h"

#include <fmt/format.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

constexpr double pixels_a_leaf_edge = 3.0;
constexpr int least_resolution = 256, largest_resolution = 4096;

/// Adds the time since the last lap to the record.
class StopWatch {
public:
    explicit StopWatch(RunRecord* run) : run_(run) {}
    void lap(const char* phase) {
        const auto now = std::chrono::steady_clock::now();
        if (run_)
            run_->seconds.emplace_back(phase, std::chrono::duration<double>(now - last_).count());
        last_ = now;
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

/// 64-bit FNV-1a over what light sees of a scene.
class SceneHash {
public:
    void add(std::uint64_t bits) {
        for (int i = 0; i < 8; ++i) hash_ = (hash_ ^ ((bits >> (8 * i)) & 0xff)) * 0x100000001b3u;
    }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(const Spectrum& s) {
        for (int i = 0; i < channel_count; ++i) add(double{s[i]});
    }
    [[nodiscard]] std::string text() const { return fmt::format("{:016x}", hash_); }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

std::string hash_scene(const SurfaceMesh& mesh) {
    SceneHash h;
    for (const glm::dvec3& p : mesh.positions)
        for (int i = 0; i < 3; ++i) h.add(p[i]);
    for (const RootTriangle& t : mesh.triangles) {
        for (const std::uint32_t v : t.vertices) h.add(std::uint64_t{v});
        h.add(std::uint64_t{t.material});
    }
    for (const Material& m : mesh.materials) {
        h.add(m.diffuse);
        h.add(m.specular);
        h.add(static_cast<std::uint64_t>(m.lobe));
        h.add(double{m.shininess});
        h.add(double{m.roughness});
        h.add(m.emission);
        h.add(std::uint64_t{m.back_reflects} | std::uint64_t{m.back_emits} << 1);
    }
    return h.text();
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

void record_settings(const BakeOptions& o, Solution& s) {
    const char* const shots[] = {"auto", "off", "hemicube"};
    s.settings = {{"patch-size", fmt::format("{}", o.subdivision.patch_size)},
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
                  {"seed", fmt::format("{}", o.seed)}};
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
    s.scene_hash = hash_scene(s.surface);
    s.glossy =
        lay_out_glossy_sides(s.surface, s.patches, choose_bin_levels(s.surface, options.bins));
    decide_bins(s, options.bins, s.decisions);
    watch.lap("geometry");

    LightSampleOptions light = options.light;
    light.seed = options.seed;
    const Luminaires luminaires = sample_luminaires(s.surface, light, s.lighting.lights);
    decide_first_shot(luminaires, light.first_shot, s.decisions);
    s.direct = shoot_direct_light(s.surface, s.patches, luminaires, options.hemicube_resolution,
                                  workers, monitor);
    s.direct_irradiance = direct_irradiance(s.direct, s.patches.patch_count());
    s.interrupted = monitor.stop_requested();
    watch.lap("first shot");

    IterationOptions iteration = options.iteration;
    iteration.seed = options.seed;
    iteration.pixel_size = options.resolution > 0 ? pixel_size_for(s.surface, options.resolution)
                                                  : automatic_pixel_size(s.surface, s.patches);
    const PatchSources sources = make_sources(s);
    if (!shines(sources)) {
        iteration.iterations = 0;
        s.decisions.push_back({"no iteration", "no surface reflects the direct light"});
    }
    if (!s.lighting.environment.shines())
        s.decisions.push_back({"no environment", "the scene has none"});
    TransportResult transport = iterate(s.surface, s.patches, sources, iteration, workers, monitor);
    watch.lap("transport");

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
    note_decisions(s, monitor);
    if (run) run->threads = workers.count();
    return s;
}

}  // namespace transillum
