/// Materials whose spectra were measured.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/colours.h>
#include <transillum/scene/spectrum_table.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace transillum {

/// Spectra that take the place of what the scene says of all materials of that name, textures
/// among it.
struct MeasuredMaterial {
    std::string name;
    std::optional<SpectrumTable> reflectance;  ///< of the Lambert part [1]
    std::optional<SpectrumTable> specular;     ///< of the lobe, as Material::specular [1]
    std::optional<SpectrumTable> emission;     ///< radiance, in a unit of its own
    /// What a value of 1 of the emission is as radiance in the scene's unit; where none is given,
    /// the emission keeps the luminance that the scene gives the material.
    std::optional<double> emission_scale;
};

/// Reads a JSON file that maps names of materials to columns of CSV files (spectrum_table.h):
///
///   { "red wall": { "reflectance": { "file": "walls.csv", "column": "red" } },
///     "lamp": { "emission": { "file": "lamps.csv", "column": "halogen", "scale": 2.5 } } }
///
/// beside `reflectance` and `emission`, `specular` is accepted; file names are relative to the JSON
/// file; `scale` may be left out. \throws IoError; InputError naming file and entry where it is not
/// of that form, names no material of the scene, a spectrum does not span 400 to 700 nm, reflects
/// more than 1, or is of a lobe or an emission that the material has not.
[[nodiscard]] std::vector<MeasuredMaterial> read_measured_materials(
    const std::filesystem::path& path, const std::vector<Material>& materials);

/// What a scene is baked from where it is baked in bands.
struct SpectralOptions {
    int bands = 12;
    std::vector<MeasuredMaterial> measured;
    float max_albedo = 0.99f;  ///< measured materials are limited to it, as by limit_albedo
};

/// The colours with those of measured materials put in: their RGB, within [0, 1] where they
/// reflect and not negative where they emit.
[[nodiscard]] Colours measured_colours(const Colours& rgb, const SpectralOptions& options,
                                       const Bands& bands, Monitor& monitor);
/// The same in a group of bands.
[[nodiscard]] Colours measured_colours_in_group(const Colours& rgb, const SpectralOptions& options,
                                                const Bands& bands, int group, Monitor& monitor);

}  // namespace transillum
