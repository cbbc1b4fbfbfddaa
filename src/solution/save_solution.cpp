#include <transillum/solution/save_solution.h>
#include <transillum/solution/stored_patches.h>

#include "check_solution.h"
#include "index_file.h"
#include "pieces/pieces.h"
#include "replace_files.h"
#include "run_record.h"
#include "vtk_bytes.h"

#include <transillum/base/error.h>

#include <algorithm>
#include <iterator>

namespace transillum {

namespace {

using NamedBytes = std::vector<std::pair<std::string, std::string>>;

/// The name also stands in the index file, which is XML.
void check_name(const Path& path) {
    const std::string name = path.stem().string();
    const bool has_control_codes = std::any_of(
        name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
    if (path.extension() != ".vtm" || name.empty() || has_control_codes) {
        throw UsageError(path.string() + ": a solution is written to NAME.vtm");
    }
}

NamedBytes format_pieces(const Solution& solution, const Radiances& shown, const Path& folder) {
    NamedBytes pieces;
    const auto add = [&](const char* name, const PolyData& piece) {
        pieces.emplace_back(name, to_vtp(*piece, folder / (std::string(name) + ".vtp")));
    };
    const Patches stored = stored_patches(solution);
    add("radiance", radiance_piece(solution, stored, shown));
    if (!solution.direct.samples.empty()) add("incoming", incoming_piece(solution, stored));
    add("lights", lights_piece(solution));
    const Environment& environment = solution.lighting.environment;
    if (environment.image) add("environment", environment_piece(*environment.image));
    const PolyData surface = surface_piece(solution);
    add_summary(solution, *surface->GetFieldData());
    add("surface", surface);
    if (solution.continuation) add("sums", sums_piece(solution));
    const std::vector<std::uint32_t> textures = used_textures(solution.surface);
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const std::string name = texture_piece_name(i);
        const ImageData piece = texture_piece(*solution.surface.textures[textures[i]]);
        pieces.emplace_back(name, to_vti(*piece, folder / file_of_piece(name)));
    }
    return pieces;
}

void check_sound(const Solution& solution, const Path& path) {
    if (const std::string defect = find_defect(solution); !defect.empty()) {
        throw Error(path.string() + ": not saved, the solution is unsound: " + defect);
    }
}

void save_pieces(NamedBytes pieces, const RunRecord& run, const Path& path) {
    SolutionFiles files;
    files.pieces = std::move(pieces);
    files.index = format_index(index_of(path.stem().string(), files.pieces));
    for (auto& [name, bytes] : files.pieces) name = file_of_piece(name);
    files.pieces.emplace_back("run.json", format_run_record(run));
    replace_files(files, path);
}

/// Adds the radiance of a group to that of others, as RGB.
void add_converted(const Radiances& of_group, const glm::dmat3& rgb_from_group, Radiances& sum) {
    for (const auto member :
         {&Radiances::emission, &Radiances::direct, &Radiances::finite_element}) {
        std::vector<Spectrum>& to = sum.*member;
        to.resize((of_group.*member).size(), Spectrum(0.0f));
        for (std::size_t p = 0; p < to.size(); ++p)
            to[p] += Spectrum(rgb_from_group * SpectrumSum((of_group.*member)[p]));
    }
}

}  // namespace

void save_solution(const Solution& solution, const RunRecord& run, const Path& path) {
    check_name(path);
    check_sound(solution, path);
    save_pieces(format_pieces(solution, radiances_of(solution), Path(path).replace_extension()),
                run, path);
}

void save_emitter_solution(const EmitterSolution& solution, const RunRecord& run,
                           const Path& path) {
    check_name(path);
    check_sound(solution.all, path);
    const Path folder = Path(path).replace_extension();
    NamedBytes pieces = format_pieces(solution.all, radiances_of(solution.all), folder);
    for (std::size_t i = 0; i < solution.parts.size(); ++i) {
        const std::string name = emitter_piece_name(i);
        pieces.emplace_back(name,
                            to_vtp(*emitter_piece(solution, i), folder / file_of_piece(name)));
    }
    save_pieces(std::move(pieces), run, path);
}

void save_spectral_solution(const SpectralSolution& spectral, const RunRecord& run,
                            const Path& path) {
    check_name(path);
    check_sound(spectral.rgb, path);
    const Bands bands(spectral.bands);
    const Path folder = Path(path).replace_extension();
    Radiances shown;
    NamedBytes groups;
    Solution solution = spectral.rgb;
    for (int g = 0; g < bands.groups(); ++g) {
        put_into_group(solution, spectral, bands, g);
        check_sound(solution, path);
        add_converted(radiances_of(solution), bands.rgb_from_group(g), shown);
        const std::string name = band_piece_name(g);
        groups.emplace_back(name,
                            to_vtp(*band_piece(spectral, bands, g), folder / file_of_piece(name)));
    }
    NamedBytes pieces = format_pieces(spectral.rgb, shown, folder);
    std::ranges::move(groups, std::back_inserter(pieces));
    save_pieces(std::move(pieces), run, path);
}

}  // namespace transillum
