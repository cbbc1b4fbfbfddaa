#include "members.h"
#include "pieces.h"

#include "solution/vtk_arrays.h"

#include <transillum/base/error.h>

#include <vtkNew.h>
#include <vtkPoints.h>

#include <array>
#include <cmath>

namespace transillum {

namespace {

template <class Each>
void for_colour_members(Each each) {
    each("MaterialDiffuse", &MaterialColours::diffuse);
    each("MaterialSpecular", &MaterialColours::specular);
    each("MaterialEmission", &MaterialColours::emission);
}

/// Calls `each(array name, member, number of values)`.
template <class Each>
void for_light_members(const Solution& solution, Each each) {
    const std::size_t patches = solution.patches.patch_count();
    each("DirectIrradiance", &BandGroup::direct_irradiance, patches);
    each("IndirectIrradiance", &BandGroup::indirect_irradiance, patches);
    each("StandardError", &BandGroup::standard_error, patches);
    each("GlossyElements", &BandGroup::glossy_elements, solution.glossy.element_count);
}

/// Where each channel's band begins and ends [nm].
std::array<double, 6> wavelengths_of(const Bands& bands, int group) {
    std::array<double, 6> edges{};
    for (int c = 0; c < channel_count; ++c) {
        const int band = bands.band_of(group, c);
        edges[static_cast<std::size_t>(2 * c)] = bands.edge(band);
        edges[static_cast<std::size_t>(2 * c + 1)] = bands.edge(band + 1);
    }
    return edges;
}

void check_values(const std::vector<Spectrum>& values, const char* array, const Path& file) {
    for (std::size_t i = 0; i < values.size(); ++i)
        for (int c = 0; c < channel_count; ++c)
            if (!(values[i][c] >= 0.0f) || !std::isfinite(values[i][c]))
                throw InputError(file.string(), std::string("array '") + array + "', entry " +
                                                    std::to_string(i) + ": " +
                                                    std::to_string(values[i][c]) +
                                                    " is not a finite number of at least 0");
}

}  // namespace

std::string band_piece_name(int group) {
    const std::string number = std::to_string(group + 1);
    return "bands-" + std::string(number.size() < 2 ? 1 : 0, '0') + number;
}

PolyData band_piece(const SpectralSolution& spectral, const Bands& bands, int group) {
    const BandGroup& own = spectral.groups[static_cast<std::size_t>(group)];
    auto piece = PolyData::New();
    piece->SetPoints(vtkNew<vtkPoints>());  // VTK cannot read a file without
    vtkFieldData& fields = *piece->GetFieldData();
    add_value(fields, "BandCount", std::int32_t{bands.count()});
    add_value(fields, "Wavelengths", wavelengths_of(bands, group));
    add_strings(fields, "SceneHash", {spectral.rgb.scene_hash});
    for_colour_members(
        [&](const char* name, auto member) { add_member(fields, name, own.materials, member); });
    for_light_members(spectral.rgb, [&](const char* name, auto member, std::size_t) {
        add_array(fields, name, (own.*member).size(),
                  [&](std::size_t i) { return (own.*member)[i]; });
    });
    return piece;
}

int read_band_count(vtkPolyData& piece, const Path& file) {
    const auto count =
        ArrayReader{*piece.GetFieldData(), file}.read_value<std::int32_t>("BandCount");
    if (count < least_bands || count > most_bands)
        throw InputError(file.string(), "array 'BandCount': " + std::to_string(count) +
                                            " bands; accepted: " + std::to_string(least_bands) +
                                            " to " + std::to_string(most_bands));
    return count;
}

void read_band_piece(vtkPolyData& piece, const Path& file, const Bands& bands, int group,
                     SpectralSolution& spectral) {
    const ArrayReader reader{*piece.GetFieldData(), file};
    if (read_band_count(piece, file) != bands.count() ||
        reader.read_value<std::array<double, 6>>("Wavelengths") != wavelengths_of(bands, group))
        throw InputError(file.string(), "its bands are not those of group " +
                                            std::to_string(group + 1) + " of " +
                                            std::to_string(bands.groups()));
    if (const std::string hash = reader.read_strings("SceneHash", 1)[0];
        hash != spectral.rgb.scene_hash)
        throw InputError(file.string(), "is of the scene " + hash + ", the solution of " +
                                            spectral.rgb.scene_hash);
    BandGroup own;
    own.materials.resize(spectral.rgb.surface.materials.size());
    for_colour_members([&](const char* name, auto member) {
        check_values(reader.read<Spectrum>(name, own.materials.size()), name, file);
        read_member(reader, name, own.materials, member);
    });
    for_light_members(spectral.rgb, [&](const char* name, auto member, std::size_t count) {
        own.*member = reader.read<Spectrum>(name, count);
        check_values(own.*member, name, file);
    });
    spectral.groups.push_back(std::move(own));
}

}  // namespace transillum
