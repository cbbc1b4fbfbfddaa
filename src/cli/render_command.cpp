#include "cli/camera_options.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/shading_options.h"

#include <transillum/base/error.h>
#include <transillum/render/render_bands.h>
#include <transillum/solution/load_solution.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace transillum::cli {

namespace {

struct RenderArguments {
    std::string solution;
    CameraOptions camera;
    ImageOptions image;
    ShadingOptions shading;
};

int run(const RenderArguments& a, const Common& common) {
    Console console(common);
    require_writable(a.image);
    const RenderOptions render = make_render_options(a.shading, parse_size(a.camera.size));
    const SpectralSolution solution = load_spectral_solution(a.solution);
    const Camera camera = make_camera(a.camera, solution.rgb.cameras, solution.rgb.surface);
    const Image image = render_bands(solution, camera, render, Workers(a.shading.threads), console);
    if (console.stop_requested()) return ExitCode::interrupted;
    if (std::ranges::all_of(image.pixels, [](const Spectrum& p) { return p == Spectrum(0.0f); }))
        console.warn(fmt::format(
            "the picture is black: from eye {:g},{:g},{:g} nothing that shines is seen; scene "
            "coordinates are those of the file ('info' lists cameras)",
            camera.eye.x, camera.eye.y, camera.eye.z));
    write_images(image, a.image);
    return ExitCode::done;
}

}  // namespace

void add_render(CLI::App& program, const Common& common, int& exit_code) {
    auto a = std::make_shared<RenderArguments>();
    CLI::App* command = program.add_subcommand("render", "Look at a solution from a viewpoint");
    command->add_option("SOLUTION", a->solution, "what bake wrote: NAME.vtm")->required();
    add_camera_options(*command, a->camera);
    add_image_options(*command, a->image);
    add_shading_options(*command, a->shading);
    command->footer(
        "Examples:\n"
        "  transillum render room.vtm -o room.png\n"
        "  transillum render room.vtm --eye 0,1.7,3 --look-at 0,1,0 --fov 60 --size 1280x720 -o "
        "near.png -o near.exr");
    command->callback([a, &common, &exit_code] { exit_code = run(*a, common); });
}

}  // namespace transillum::cli
