#include <transillum/solution/load_solution.h>

#include "check_solution.h"

#include "checksum.h"
#include "index_file.h"
#include "pieces/pieces.h"
#include "replace_files.h"
#include "solution/leaf_colours.h"
#include "vtk_bytes.h"

#include <transillum/base/error.h>

#include <algorithm>

namespace transillum {

namespace {

/// The pieces of one solution, read when asked for.
class Pieces {
public:
    explicit Pieces(const Path& path) : path_(path), index_(parse_index(read_bytes(path), path)) {}

    [[nodiscard]] Path file(const std::string& name) const {
        return path_.parent_path() / index_.folder / file_of_piece(name);
    }

    [[nodiscard]] bool has(const std::string& name) const {
        return std::ranges::any_of(index_.pieces,
                                   [&](const IndexedPiece& each) { return each.name == name; });
    }

    [[nodiscard]] PolyData read(const std::string& name) const {
        return from_vtp(bytes_of(name), file(name));
    }

    [[nodiscard]] ImageData read_image(const std::string& name) const {
        return from_vti(bytes_of(name), file(name));
    }

private:
    [[nodiscard]] std::string bytes_of(const std::string& name) const {
        const auto piece =
            std::find_if(index_.pieces.begin(), index_.pieces.end(),
                         [&](const IndexedPiece& each) { return each.name == name; });
        if (piece == index_.pieces.end()) {
            throw InputError(path_.string(), "the block '" + name + "' is missing");
        }
        std::string bytes = read_bytes(file(name));
        check(bytes, *piece);
        return bytes;
    }

    void check(const std::string& bytes, const IndexedPiece& piece) const {
        if (bytes.size() != piece.bytes) {
            throw InputError(file(piece.name).string(), "damaged: " + std::to_string(bytes.size()) +
                                                            " bytes, " + path_.filename().string() +
                                                            " says " + std::to_string(piece.bytes));
        }
        if (crc32(bytes) != piece.checksum) {
            throw InputError(
                file(piece.name).string(),
                "damaged: its bytes do not match their checksum in " + path_.filename().string());
        }
    }

    Path path_;
    IndexFile index_;
};

void read_textures(const Pieces& pieces, SurfaceMesh& surface) {
    for (std::size_t i = 0; i < surface.textures.size(); ++i) {
        const std::string name = texture_piece_name(i);
        Texture texture = read_texture_piece(*pieces.read_image(name), pieces.file(name));
        texture.build_levels();
        surface.textures[i] = std::make_shared<const Texture>(std::move(texture));
    }
}

Solution load(const Pieces& pieces, const Path& path) {
    const auto read = [&](const std::string& name, auto read_piece, auto& into) {
        read_piece(*pieces.read(name), pieces.file(name), into);
    };
    Solution solution;
    const PolyData surface = pieces.read("surface");
    read_summary(*surface->GetFieldData(), pieces.file("surface"), solution);
    read_surface_piece(*surface, pieces.file("surface"), solution);
    read_textures(pieces, solution.surface);
    read("lights", read_lights_piece, solution);
    Environment& environment = solution.lighting.environment;
    if (environment.kind == Environment::Kind::image)
        read("environment", read_environment_piece, environment);
    read("radiance", read_radiance_piece, solution);
    if (!solution.direct.samples.empty()) read("incoming", read_incoming_piece, solution);
    if (const std::string defect = find_defect(solution); !defect.empty()) {
        throw InputError(path.string(), defect);
    }
    average_textures(solution);
    return solution;
}

}  // namespace

Solution load_solution(const Path& path) {
    return load(Pieces(path), path);
}

std::optional<Solution> find_baked(const Path& path, const std::string& input_hash) {
    if (!std::filesystem::exists(path)) return std::nullopt;
    try {
        if (load_run_record(path).input_hash != input_hash) return std::nullopt;
        Solution solution = load_solution(path);
        if (solution.interrupted) return std::nullopt;
        return solution;
    } catch (const Error&) {
        return std::nullopt;
    }
}

Solution load_solution_to_go_on(const Path& path) {
    const Pieces pieces(path);
    if (pieces.has(band_piece_name(0)))
        throw InputError(path.string(),
                         "a solution in bands of wavelengths, which can't be gone on from; "
                         "accepted: one in RGB (bake without --spectral)");
    if (!pieces.has("sums"))
        throw InputError(path.string(),
                         "holds no sums to go on from: they were not kept, or the bake was "
                         "interrupted before its first direction; accepted: a solution baked with "
                         "--keep-sums on, without --keep-emitters");
    Solution solution = load(pieces, path);
    read_sums_piece(*pieces.read("sums"), pieces.file("sums"), solution);
    return solution;
}

EmitterSolution load_emitter_solution(const Path& path) {
    const Pieces pieces(path);
    const std::string first = emitter_piece_name(0);
    if (!pieces.has(first))
        throw InputError(path.string(),
                         "does not tell its emitters apart; accepted: a solution baked with "
                         "--keep-emitters");
    EmitterSolution solution{load(pieces, path), {}};
    const std::size_t count = read_emitter_count(*pieces.read(first), pieces.file(first));
    for (std::size_t i = 0; i < count; ++i) {
        const std::string name = emitter_piece_name(i);
        read_emitter_piece(*pieces.read(name), pieces.file(name), solution);
    }
    return solution;
}

SpectralSolution load_spectral_solution(const Path& path) {
    const Pieces pieces(path);
    SpectralSolution spectral{load(pieces, path), 0, {}};
    const std::string first = band_piece_name(0);
    if (!pieces.has(first)) return spectral;
    const Bands bands(read_band_count(*pieces.read(first), pieces.file(first)));
    spectral.bands = bands.count();
    for (int g = 0; g < bands.groups(); ++g) {
        const std::string name = band_piece_name(g);
        read_band_piece(*pieces.read(name), pieces.file(name), bands, g, spectral);
    }
    return spectral;
}

}  // namespace transillum
