#include "physics/transport_runs.h"

#include <transillum/visibility/transillumination_buffer.h>

#include <numbers>

namespace transillum::testing_support {

double TransportRun::mean_incoming(const std::function<bool(std::uint32_t, bool)>& chosen) const {
    double sum = 0.0, area = 0.0;
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
        const std::uint32_t root = patches.root_of_leaf[patches.leaf_of_patch(p)];
        if (!chosen(root, patches.is_back(p))) continue;
        const double a = area_of_leaf(surface, patches, patches.leaf_of_patch(p));
        sum += a * result.irradiance[p].x;
        area += a;
    }
    return sum / area / std::numbers::pi;
}

double TransportRun::radiance(std::uint32_t patch) const {
    return sources.emission[patch].x +
           sources.albedo[patch].x * result.irradiance[patch].x / std::numbers::pi;
}

TransportRun prepare_transport(const Scene& scene, const RunOptions& options) {
    Monitor silent;
    const SurfaceMesh surface = build_surface(scene, {}, silent);
    SubdivisionOptions subdivision;
    subdivision.leaf_target = options.leaves;
    subdivision.max_level = options.max_level;
    TransportRun run = prepare_transport(surface, subdivide_uniformly(surface, subdivision));
    run.sources.environment = scene.lighting.environment;
    return run;
}

TransportRun prepare_transport(const SurfaceMesh& surface, const PatchHierarchy& patches) {
    TransportRun run{surface, patches, {}, {}};
    for (std::uint32_t p = 0; p < run.patches.patch_count(); ++p) {
        const std::uint32_t root = run.patches.root_of_leaf[run.patches.leaf_of_patch(p)];
        const Material& m = run.surface.materials[run.surface.triangles[root].material];
        const bool back = run.patches.is_back(p);
        run.sources.emission.push_back(!back || m.back_emits ? m.emission : Spectrum(0.0f));
        run.sources.direct.emplace_back(0.0f);
        run.sources.albedo.push_back(!back || m.back_reflects ? m.diffuse : Spectrum(0.0f));
    }
    run.sources.glossy = lay_out_glossy_sides(surface, patches, choose_bin_levels(surface, {}));
    return run;
}

void iterate_in(TransportRun& run, const RunOptions& options) {
    Monitor silent;
    IterationOptions iteration;
    iteration.iterations = options.directions;
    iteration.pixel_size = pixel_size_for(run.surface, options.resolution);
    iteration.seed = options.seed;
    iteration.averaging = options.averaging;
    iteration.monte_carlo = options.monte_carlo;
    run.result =
        iterate(run.surface, run.patches, run.sources, iteration, Workers(options.threads), silent);
}

TransportRun run_transport(const Scene& scene, const RunOptions& options) {
    TransportRun run = prepare_transport(scene, options);
    iterate_in(run, options);
    return run;
}

TransportRun run_transport(const SurfaceMesh& surface, const PatchHierarchy& patches,
                           const RunOptions& options) {
    TransportRun run = prepare_transport(surface, patches);
    iterate_in(run, options);
    return run;
}

Scene cube_scene(float albedo, float floor, float others) {
    SceneBuilder b;
    const std::uint32_t floor_material = b.material(Spectrum(albedo), Spectrum(floor));
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, b.material(Spectrum(albedo), Spectrum(others)));
    b.scene.polygons[0].material = floor_material;
    return b.scene;
}

Scene two_rooms_scene(float albedo) {
    SceneBuilder b;
    const std::uint32_t white = b.material(Spectrum(albedo));
    const int low_x = 4, high_x = 5;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, white, high_x);
    b.scene.polygons[0].material = b.material(Spectrum(albedo), Spectrum(1.0f));
    b.box({1, 0, 0}, {2, 1, 1}, Facing::inwards, white, low_x);
    const auto wall = [&](double y0, double y1, double z0, double z1) {
        b.polygon({{1, y0, z0}, {1, y0, z1}, {1, y1, z1}, {1, y1, z0}}, white);
    };
    wall(0.0, 0.4, 0.0, 1.0);
    wall(0.6, 1.0, 0.0, 1.0);
    wall(0.4, 0.6, 0.6, 1.0);
    return b.scene;
}

bool is_in_far_room(const SurfaceMesh& surface, std::uint32_t root) {
    double x = 0.0;
    for (const std::uint32_t v : surface.triangles[root].vertices)
        x += surface.positions[v].x / 3.0;
    return x > 1.0;
}

}  // namespace transillum::testing_support
