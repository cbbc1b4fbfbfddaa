#include "cli/repair_options.h"

#include "cli/scene_options.h"

namespace transillum::cli {

void add_mesh_options(CLI::App& command, MeshOptions& options) {
    add_scene_argument(command, options.scene);
    command.add_flag("--json", options.json, "machine-readable report");
    command.add_option("--threads", options.threads, "0: as many as the machine has")
        ->capture_default_str();
}

CLI::Option* add_tolerance(CLI::App& command, double& tolerance, const std::string& what) {
    return command
        .add_option("--tolerance", tolerance,
                    "distance over the scene's diagonal, within which " + what)
        ->check(within(0.0, most_tolerance))
        ->capture_default_str();
}

void add_repair_options(CLI::App& command, const std::string& level_name, RepairOptions& options) {
    const char* const group = "Repair";
    add_choice(
        command, level_name, options.level,
        {{"off", RepairLevel::off}, {"safe", RepairLevel::safe}, {"full", RepairLevel::full}},
        "safe: drops faces without area and duplicates, turns faces that disagree with their "
        "neighbours; full: also closes cracks and cuts faces exactly where they meet. Passes "
        "run only where they find something")
        ->group(group);
    add_tolerance(command, options.tolerance,
                  "cracks are closed, and faces that overlap are taken for parts of one plane")
        ->group(group);
}

}  // namespace transillum::cli
