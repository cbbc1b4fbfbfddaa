#include "cli/spectral_options.h"

#include <transillum/base/error.h>

#include <fmt/format.h>

#include <charconv>

namespace transillum::cli {

namespace {

int band_count(const std::string& word) {
    int count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc() || end != word.data() + word.size() || count < least_bands ||
        count > most_bands)
        throw CLI::ValidationError(
            "--spectral", fmt::format("'{}' bands; accepted: {} to {}, or no number behind it",
                                      word, least_bands, most_bands));
    return count;
}

}  // namespace

void add_spectral_options(CLI::App& command, SpectralArguments& arguments) {
    command
        .add_option_function<std::string>(
            "--spectral",
            [&](const std::string& word) {
                arguments.on = true;
                arguments.bands = band_count(word);
            },
            fmt::format("work in so many bands of 400 to 700 nm, {} to {}, three at a time, "
                        "instead of RGB (without a number: {})",
                        least_bands, most_bands, arguments.bands))
        ->expected(0, 1)
        ->type_name("N")
        ->default_str(fmt::format("{}", arguments.bands))
        ->group("Wavelengths");
    command
        .add_option("--spectra", arguments.measured,
                    "JSON file that gives materials measured spectra, as "
                    "data/spectra/cornell.json; others get a smooth one from their RGB")
        ->group("Wavelengths");
}

std::optional<SpectralOptions> make_spectral_options(const SpectralArguments& arguments,
                                                     float max_albedo, const Scene& scene) {
    if (!arguments.on && !arguments.measured.empty())
        throw UsageError("--spectra " + arguments.measured +
                         " without bands; accepted: together with --spectral");
    if (!arguments.on) return std::nullopt;
    SpectralOptions options{arguments.bands, {}, max_albedo};
    if (!arguments.measured.empty())
        options.measured = read_measured_materials(arguments.measured, scene.materials);
    return options;
}

}  // namespace transillum::cli
