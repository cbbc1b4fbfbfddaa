#include "cli/shading_options.h"

#include "cli/scene_options.h"

#include <transillum/base/error.h>

namespace transillum::cli {

Components chosen_components(const std::vector<std::string>& words) {
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

void add_shading_options(CLI::App& command, ShadingOptions& options, const std::string& automatic) {
    add_choice(command, "--direct", options.render.direct,
               {{"stored", DirectShading::stored},
                {"traced", DirectShading::traced},
                {"traced-everywhere", DirectShading::traced_everywhere}},
               "direct light: as stored a patch, or by shadow rays to the light samples: where "
               "those are seen in part, or from every point")
        ->group("Shading");
    command
        .add_option("--components", options.components,
                    "of: emission, direct, finite-element, monte-carlo (default: all)")
        ->delimiter(',')
        ->check(CLI::IsMember({"emission", "direct", "finite-element", "monte-carlo"}))
        ->group("Shading");
    add_choice(command, "--monte-carlo", options.render.monte_carlo,
               {{"auto", MonteCarloShading::automatic},
                {"off", MonteCarloShading::off},
                {"rays", MonteCarloShading::rays},
                {"subpatch", MonteCarloShading::subpatch},
                {"wavefront", MonteCarloShading::wavefront}},
               "what patches can't hold: by rays from glossy points; by new bundles, on patches' "
               "quarters (carried from frame to frame) or in deep buffers; auto, where surfaces "
               "are glossy: " +
                   automatic)
        ->group("Shading");
    command.add_flag("--flat", options.flat, "one radiance a patch instead of interpolation")
        ->group("Shading");
    command
        .add_option("--iterations", options.render.iterations,
                    "most samples a pixel of the Monte-Carlo component and of what sharp lobes "
                    "mirror, calm pixels get fewer; and new bundles a picture")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str()
        ->group("Shading");
    add_sampling_options(command,
                         {options.render.samples, 4096, "most rays a pixel; flat pixels get fewer",
                          options.render.seed, "of the positions in a pixel, and of chance",
                          options.threads, "Shading"});
}

RenderOptions make_render_options(const ShadingOptions& options, Size size) {
    RenderOptions render = options.render;
    render.width = size.width;
    render.height = size.height;
    render.components = chosen_components(options.components);
    render.interpolate = !options.flat;
    const bool asked_for = render.monte_carlo != MonteCarloShading::automatic &&
                           render.monte_carlo != MonteCarloShading::off;
    if (asked_for && !render.components.monte_carlo)
        throw UsageError(
            "--monte-carlo asks for what --components leaves out; accepted: "
            "monte-carlo among the components");
    return render;
}

}  // namespace transillum::cli
