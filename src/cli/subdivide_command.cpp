#include "cli/command.h"
#include "cli/console.h"
#include "cli/scene_options.h"

#include <transillum/base/error.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/subdivide_scene.h>
#include <transillum/scene/save_scene.h>

#include <memory>

namespace transillum::cli {

void add_subdivide(CLI::App& program, const Common& common, int& exit_code) {
    struct SubdivideArguments {
        std::string scene, output;
        LoadOptions load;
        SceneSubdivision subdivision;
    };
    auto a = std::make_shared<SubdivideArguments>();
    CLI::App* command = program.add_subcommand(
        "subdivide",
        "Cut a scene's polygons into small triangles, exactly and without T-junctions");
    command->add_option("SCENE", a->scene, "scene: .gltf .glb .obj .ply .stl .off")->required();
    command
        ->add_option("-o,--output", a->output,
                     "scene to write, of any of these formats (.stl and .gltf round to floats)")
        ->required();
    CLI::Option* edge = command
                            ->add_option("--max-edge", a->subdivision.max_edge,
                                         "longest edge of a triangle [scene units]")
                            ->check(CLI::PositiveNumber);
    CLI::Option* level =
        command->add_option("--max-level", a->subdivision.level, "cut every triangle into 4^N")
            ->check(CLI::Range(0, max_subdivision_level))
            ->excludes(edge);
    command->footer(
        "Example:\n"
        "  transillum subdivide room.obj -o fine.obj --max-edge 0.1");
    command->callback([=, &common, &exit_code] {
        if (edge->count() + level->count() == 0)
            throw UsageError("subdivide needs a limit; accepted: --max-edge or --max-level");
        (void)holds_polygons(a->output);
        require_writable(a->output);
        Console console(common);
        const Scene scene = load_scene(a->scene, a->load, console);
        save_scene(subdivide_scene(scene, a->subdivision, console), a->output, console);
        exit_code = ExitCode::done;
    });
}

}  // namespace transillum::cli
