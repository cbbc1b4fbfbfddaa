#include "cli/camera_options.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/scene_options.h"
#include "cli/shading_options.h"

#include <transillum/base/error.h>
#include <transillum/render/make_radiance_mesh.h>
#include <transillum/solution/load_solution.h>
#include <transillum/solution/save_radiance_mesh.h>

#include <fmt/format.h>

#include <memory>

namespace transillum::cli {

namespace {

struct ExportArguments {
    std::string solution;
    std::vector<std::string> paths, components;
    RadianceMeshOptions mesh;
    bool flat = false;
    int threads = 0;
};

int run(ExportArguments& a, const Common& common) {
    Console console(common);
    for (const std::string& path : a.paths) {
        require_mesh_extension(path);
        require_writable(path);
    }
    a.mesh.components = chosen_components(a.components);
    a.mesh.interpolate = !a.flat;
    const RadianceMesh mesh =
        make_radiance_mesh(load_spectral_solution(a.solution), a.mesh, Workers(a.threads));
    for (const std::string& path : a.paths) {
        save_radiance_mesh(mesh, path);
        fmt::print("{}: {} triangles, {} vertices\n", path, mesh.triangles.size(),
                   mesh.positions.size());
    }
    console.note(
        fmt::format("exposure: display colours are radiance times 2^{:.2f}, highlights "
                    "compressed",
                    mesh.exposure));
    return ExitCode::done;
}

}  // namespace

void add_export(CLI::App& program, const Common& common, int& exit_code) {
    auto a = std::make_shared<ExportArguments>();
    CLI::App* command = program.add_subcommand(
        "export", "Write a solution's radiance as a mesh for other programs");
    command->add_option("SOLUTION", a->solution, "what bake wrote: NAME.vtm")->required();
    command
        ->add_option("-o,--output", a->paths,
                     "mesh with vertex colours: .glb unlit glTF, for any viewer; .ply; .vtp, with "
                     "radiance in floating point; may be given more than once")
        ->allow_extra_args(false)
        ->required()
        ->group("Output");
    add_tone_options(*command, a->mesh.tone, "vertex colours of .glb and .ply");
    command
        ->add_option("--components", a->components,
                     "of: emission, direct, finite-element (default: all); direct alone, or "
                     "finite-element alone, what is indirect")
        ->delimiter(',')
        ->check(CLI::IsMember({"emission", "direct", "finite-element"}))
        ->group("Shading");
    command->add_flag("--flat", a->flat, "one radiance a patch instead of interpolation")
        ->group("Shading");
    command->add_option("--threads", a->threads, "0: as many as the machine has")
        ->capture_default_str()
        ->group("Shading");
    command->footer(
        "Examples:\n"
        "  transillum export room.vtm -o room.glb\n"
        "  transillum export room.vtm -o indirect.ply --components finite-element");
    command->callback([a, &common, &exit_code] { exit_code = run(*a, common); });
}

}  // namespace transillum::cli
