#include "cli/camera_options.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/scene_options.h"

#include <transillum/base/error.h>
#include <transillum/render/render_solution.h>
#include <transillum/solution/load_solution.h>

#include <fmt/format.h>

#include <memory>

namespace transillum::cli {

namespace {

struct RenderArguments {
    std::string solution;
    CameraOptions camera;
    ImageOptions image;
    RenderOptions render;
    std::vector<std::string> components;
    bool flat = false;
    int threads = 0;
};

Components chosen(const std::vector<std::string>& words) {
    if (words.empty()) return {};
    Components c{false, false, false, false};
    for (const std::string& word : words) {
        if (word == "emission") c.emission = true;
        if (word == "direct") c.direct = true;
        if (word == "finite-element") c.finite_element = true;
        if (word == "monte-carlo") c.monte_carlo = true;
    }
    return c;
}

int run(RenderArguments& a, const Common& common) {
    Console console(common.quiet);
    require_writable(a.image);
    const auto [width, height] = parse_size(a.camera.size);
    a.render.width = width;
    a.render.height = height;
    a.render.components = chosen(a.components);
    a.render.interpolate = !a.flat;
    const Solution solution = load_solution(a.solution);
    const Camera camera = make_camera(a.camera, solution.cameras, solution.surface);
    const Image image = render_solution(solution, camera, a.render, Workers(a.threads), console);
    if (console.stop_requested()) return ExitCode::interrupted;
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
    add_choice(*command, "--direct", a->render.direct,
               {{"stored", DirectShading::stored}, {"traced", DirectShading::traced}},
               "direct light: as stored a patch, or by shadow rays to the light samples")
        ->group("Shading");
    command
        ->add_option("--components", a->components,
                     "of: emission, direct, finite-element, monte-carlo (default: all, the last "
                     "where surfaces are glossy)")
        ->delimiter(',')
        ->check(CLI::IsMember({"emission", "direct", "finite-element", "monte-carlo"}))
        ->group("Shading");
    command->add_flag("--flat", a->flat, "one radiance a patch instead of interpolation")
        ->group("Shading");
    command
        ->add_option("--iterations", a->render.iterations,
                     "most samples a pixel of the Monte-Carlo component and of what sharp lobes "
                     "mirror; calm pixels get fewer")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str()
        ->group("Shading");
    add_sampling_options(
        *command,
        {a->render.samples, 4096, "most rays a pixel; flat pixels get fewer", a->render.seed,
         "of the positions in a pixel, and of chance", a->threads, "Shading"});
    command->callback([a, &common, &exit_code] { exit_code = run(*a, common); });
}

}  // namespace transillum::cli
