/// Options of subcommands that show a solution.
#pragma once

#include "cli/camera_options.h"

#include <transillum/render/render_solution.h>

#include <string>
#include <vector>

namespace transillum::cli {

struct ShadingOptions {
    RenderOptions render;
    std::vector<std::string> components;  ///< none: all
    bool flat = false;
    int threads = 0;
};

void add_shading_options(CLI::App& command, ShadingOptions& options,
                         const std::string& automatic = "rays");

/// All where there are no words.
[[nodiscard]] Components chosen_components(const std::vector<std::string>& words);

[[nodiscard]] RenderOptions make_render_options(const ShadingOptions& options, Size size);

}  // namespace transillum::cli
