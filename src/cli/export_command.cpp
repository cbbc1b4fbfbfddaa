#include "cli/camera_options.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/scene_options.h"
#include "cli/shading_options.h"

#include <transillum/base/error.h>
#include <transillum/render/make_lightmap.h>
#include <transillum/render/make_radiance_mesh.h>
#include <transillum/solution/load_solution.h>
#include <transillum/solution/save_radiance_mesh.h>

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace transillum::cli {

namespace {

struct ExportArguments {
    std::string solution;
    std::vector<std::string> paths, components;
    RadianceMeshOptions mesh;
    std::string lightmap;
    int lightmap_size = 0;
    bool flat = false;
    int threads = 0;
};

void check(const ExportArguments& a) {
    for (const std::string& path : a.paths) {
        require_mesh_extension(path);
        require_writable(path);
        const std::string extension = std::filesystem::path(path).extension().string();
        if (!a.lightmap.empty() && extension != ".glb")
            throw UsageError(path + ": extension '" + extension +
                             "' with --lightmap; accepted: .glb");
    }
    if (a.lightmap.empty()) return;
    if (std::filesystem::path(a.lightmap).extension() != ".exr")
        throw UsageError("--lightmap " + a.lightmap + "; accepted: a name that ends in .exr");
    require_writable(a.lightmap);
}

RadianceMesh write_lightmap(const ExportArguments& a, const SpectralSolution& solution) {
    const Lightmap lightmap = make_lightmap(
        solution, {a.mesh.components, a.lightmap_size, a.mesh.tone}, Workers(a.threads));
    write_image(lightmap.image, a.lightmap);
    fmt::print("{}: {} x {} texels of {:.3g} scene units, {} charts\n", a.lightmap,
               lightmap.image.width, lightmap.image.height, lightmap.texel, lightmap.charts);
    return lightmap.mesh;
}

int run(ExportArguments& a, const Common& common) {
    Console console(common);
    check(a);
    a.mesh.components = chosen_components(a.components);
    a.mesh.interpolate = !a.flat;
    const SpectralSolution solution = load_spectral_solution(a.solution);
    const RadianceMesh mesh = a.lightmap.empty()
                                  ? make_radiance_mesh(solution, a.mesh, Workers(a.threads))
                                  : write_lightmap(a, solution);
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
        "export", "Write a solution's radiance as a mesh or lightmap for other programs");
    command->add_option("SOLUTION", a->solution, "what bake wrote: NAME.vtm")->required();
    command
        ->add_option("-o,--output", a->paths,
                     "mesh with vertex colours: .glb unlit glTF, for any viewer; .ply; .vtp, with "
                     "radiance in floating point; may be given more than once")
        ->allow_extra_args(false)
        ->required()
        ->group("Output");
    auto* lightmap =
        command
            ->add_option("--lightmap", a->lightmap,
                         "linear radiance as a texture (.exr); the .glb then has the scene's "
                         "triangles, its UVs, those of the lightmap as second set, and a picture "
                         "of it")
            ->group("Output");
    command
        ->add_option("--lightmap-size", a->lightmap_size,
                     "edge of the lightmap [texels]; 0: two a patch's edge, at most 4096")
        ->check(CLI::Range(0, largest_lightmap))
        ->capture_default_str()
        ->needs(lightmap)
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
        ->excludes(lightmap)
        ->group("Shading");
    command->add_option("--threads", a->threads, "0: as many as the machine has")
        ->capture_default_str()
        ->group("Shading");
    command->footer(
        "Examples:\n"
        "  transillum export room.vtm -o room.glb\n"
        "  transillum export room.vtm -o indirect.ply --components finite-element\n"
        "  transillum export room.vtm -o room.glb --lightmap room.exr");
    command->callback([a, &common, &exit_code] { exit_code = run(*a, common); });
}

}  // namespace transillum::cli
