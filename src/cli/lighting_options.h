/// Options for light that comes from no surface: sky, lights without extent, photometry.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace transillum::cli {

struct LightingOptions {
    std::string environment = "none";
    double environment_rotation = 0.0;  ///< [degrees]
    double environment_scale = 1.0;
    bool keep_suns = false;
    std::string up = "y";
    std::vector<std::string> lights, photometry;
};

void add_lighting_options(CLI::App& command, LightingOptions& options);

/// The environment, its suns and the lights that the options describe.
/// \throws UsageError naming the option, what was found and what is accepted; what
/// load_environment throws.
[[nodiscard]] Lighting make_lighting(const LightingOptions& options, Monitor& monitor);

/// Gives lights of the scene the photometry that the options name: they become points that keep
/// their place, direction and colour, while the file says how strong they are.
/// \throws UsageError where no point or spot has the name; what read_ies throws.
void hang_photometry(const LightingOptions& options, Scene& scene, Monitor& monitor);

}  // namespace transillum::cli
