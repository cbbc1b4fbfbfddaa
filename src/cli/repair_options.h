/// Options of subcommands that repair a scene.
#pragma once

#include <transillum/repair/repair_scene.h>

#include <CLI/CLI.hpp>

#include <string>

namespace transillum::cli {

/// \param level_name of the option that chooses the passes
void add_repair_options(CLI::App& command, const std::string& level_name, RepairOptions& options);

}  // namespace transillum::cli
