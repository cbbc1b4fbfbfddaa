/// Options of subcommands that can work in bands of wavelengths.
#pragma once

#include <transillum/scene/measured_materials.h>
#include <transillum/scene/scene.h>

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace transillum::cli {

struct SpectralArguments {
    bool on = false;
    int bands = 12;
    std::string measured;  ///< JSON file
};

void add_spectral_options(CLI::App& command, SpectralArguments& arguments);

/// Nothing unless asked for. \throws UsageError for measured spectra without bands, else as
/// read_measured_materials.
[[nodiscard]] std::optional<SpectralOptions> make_spectral_options(
    const SpectralArguments& arguments, float max_albedo, const Scene& scene);

}  // namespace transillum::cli
