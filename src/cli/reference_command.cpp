#include "cli/camera_options.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/repair_options.h"
#include "cli/scene_options.h"
#include "cli/spectral_options.h"

#include <transillum/geometry/surface_mesh.h>
#include <transillum/render/render_bands.h>

#include <memory>

namespace transillum::cli {

namespace {

struct ReferenceArguments {
    SceneOptions scene;
    SpectralArguments spectral;
    CameraOptions camera;
    ImageOptions image;
    PathTraceOptions path_trace;
    RepairOptions repair{.rounding = Rounding::dyadic};
    int threads = 0;
};

int run(ReferenceArguments& a, const Common& common) {
    Console console(common);
    require_writable(a.image);
    const auto [width, height] = parse_size(a.camera.size);
    a.path_trace.width = width;
    a.path_trace.height = height;
    const Workers workers(a.threads);
    const Scene scene =
        repair_scene(read_scene(a.scene, console), a.repair, workers, console).scene;
    const SurfaceMesh surface = build_surface(scene, {}, console);
    const Camera camera = make_camera(a.camera, scene.cameras, surface);
    const auto spectral = make_spectral_options(a.spectral, a.scene.max_albedo, scene);
    const Image image =
        spectral
            ? path_trace_bands(surface, scene, *spectral, camera, a.path_trace, workers, console)
            : path_trace(surface, scene.lighting, camera, a.path_trace, workers, console);
    write_images(image, a.image);
    return console.stop_requested() ? ExitCode::interrupted : ExitCode::done;
}

}  // namespace

void add_reference(CLI::App& program, const Common& common, int& exit_code) {
    auto a = std::make_shared<ReferenceArguments>();
    CLI::App* command =
        program.add_subcommand("reference", "Path-trace a scene, to measure errors against");
    add_scene_options(*command, a->scene);
    add_repair_options(*command, "--repair", a->repair);
    add_spectral_options(*command, a->spectral);
    add_camera_options(*command, a->camera);
    add_image_options(*command, a->image);
    command
        ->add_option("--max-bounces", a->path_trace.max_bounces,
                     "0: no limit, roulette alone ends paths")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str()
        ->group("Paths");
    add_sampling_options(*command, {a->path_trace.samples, 1 << 24, "paths a pixel",
                                    a->path_trace.seed, "of the paths", a->threads, "Paths"});
    command->footer(
        "Example:\n"
        "  transillum reference room.gltf --size 200x200 --samples 256 -o reference.exr");
    command->callback([a, &common, &exit_code] { exit_code = run(*a, common); });
}

}  // namespace transillum::cli
