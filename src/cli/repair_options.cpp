#include "cli/repair_options.h"

#include "cli/scene_options.h"

namespace transillum::cli {

void add_repair_options(CLI::App& command, const std::string& level_name, RepairOptions& options) {
    const char* const group = "Repair";
    add_choice(
        command, level_name, options.level,
        {{"off", RepairLevel::off}, {"safe", RepairLevel::safe}, {"full", RepairLevel::full}},
        "safe: drops faces without area and duplicates, turns faces that disagree with their "
        "neighbours; full: also closes cracks and cuts faces exactly where they meet. Passes "
        "run only where they find something")
        ->group(group);
    command
        .add_option(
            "--tolerance", options.tolerance,
            "distance over the scene's diagonal, within which cracks are closed, and faces that "
            "overlap are taken for parts of one plane")
        ->check(within(0.0, 1e-3))
        ->capture_default_str()
        ->group(group);
}

}  // namespace transillum::cli
