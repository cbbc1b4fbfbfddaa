/// Options of subcommands that check or repair a scene.
#pragma once

#include <transillum/repair/repair_scene.h>

#include <CLI/CLI.hpp>

#include <string>

namespace transillum::cli {

/// What both have.
struct MeshOptions {
    std::string scene;
    int threads = 0;
    bool json = false;
};
void add_mesh_options(CLI::App& command, MeshOptions& options);

/// --tolerance, of cracks. \param what it is for: "... within which <what>"
CLI::Option* add_tolerance(CLI::App& command, double& tolerance, const std::string& what);

/// \param level_name of the option that chooses the passes
void add_repair_options(CLI::App& command, const std::string& level_name, RepairOptions& options);

}  // namespace transillum::cli
