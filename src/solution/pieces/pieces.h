/// The parts of a solution as VTK data, one .cpp a part. Readers check all they read against the
/// file's promise; ranges and indices are checked once more, together, by check_solution.
#pragma once

#include <transillum/solution/emitter_solution.h>
#include <transillum/solution/solution.h>
#include <transillum/solution/spectral_solution.h>

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace transillum {

using Patches = std::vector<std::uint32_t>;
using PolyData = vtkSmartPointer<vtkPolyData>;
using ImageData = vtkSmartPointer<vtkImageData>;
using Path = std::filesystem::path;

/// Root triangles, materials, objects, cameras, shot sides.
[[nodiscard]] PolyData surface_piece(const Solution& solution);
/// Fills `surface`, `patches`, `cameras` and `direct.shot_sides`; of textures, their number.
void read_surface_piece(vtkPolyData& piece, const Path& file, Solution& solution);

/// Textures that a material names, ascending: those that are stored, numbered anew.
[[nodiscard]] std::vector<std::uint32_t> used_textures(const SurfaceMesh& surface);
/// Point data `Texels`: bytes where that loses nothing, else floating point.
[[nodiscard]] ImageData texture_piece(const Texture& texture);
[[nodiscard]] Texture read_texture_piece(vtkImageData& piece, const Path& file);
[[nodiscard]] std::string texture_piece_name(std::size_t number);

/// Counts, settings, decisions, energy balance, units: field data of the surface.
void add_summary(const Solution& solution, vtkFieldData& fields);
void read_summary(vtkFieldData& fields, const Path& file, Solution& solution);

/// Light samples, and as field data the lights without extent and the environment but for its
/// image.
[[nodiscard]] PolyData lights_piece(const Solution& solution);
/// Fills `direct.samples` and `lighting`.
void read_lights_piece(vtkPolyData& piece, const Path& file, Solution& solution);

void add_lighting(const Lighting& lighting, vtkFieldData& fields);
void read_lighting(vtkFieldData& fields, const Path& file, Lighting& lighting);

/// The environment's image, where there is one.
[[nodiscard]] PolyData environment_piece(const Texture& image);
void read_environment_piece(vtkPolyData& piece, const Path& file, Environment& environment);

/// What a person looks at [W sr^-1 m^-2], one a patch.
struct Radiances {
    std::vector<Spectrum> emission, direct, finite_element;
};
[[nodiscard]] Radiances radiances_of(const Solution& solution);

/// What a person looks at, a cell a stored patch.
[[nodiscard]] PolyData radiance_piece(const Solution& solution, const Patches& stored,
                                      const Radiances& shown);
/// Sides that are not stored get zeros. `surface` and `patches` must be there.
void read_radiance_piece(vtkPolyData& piece, const Path& file, Solution& solution);

/// First-shot light a stored patch and light sample, or light vector.
[[nodiscard]] PolyData incoming_piece(const Solution& solution, const Patches& stored);
/// Light samples, `surface` and `patches` must be there.
void read_incoming_piece(vtkPolyData& piece, const Path& file, Solution& solution);

/// What another bake needs to go on, beside the blocks: as field data, PlainSums by name.
/// \pre the solution has a continuation
[[nodiscard]] PolyData sums_piece(const Solution& solution);
/// Fills `continuation`; all else must be there.
void read_sums_piece(vtkPolyData& piece, const Path& file, Solution& solution);

/// The light of one emitter, beside the blocks: as field data an EmitterPart's members.
[[nodiscard]] std::string emitter_piece_name(std::size_t number);
[[nodiscard]] PolyData emitter_piece(const EmitterSolution& solution, std::size_t number);
[[nodiscard]] std::size_t read_emitter_count(vtkPolyData& piece, const Path& file);
/// Adds the part to those before it. `all` must be there.
void read_emitter_piece(vtkPolyData& piece, const Path& file, EmitterSolution& solution);

/// A group of bands, beside the blocks: as field data its wavelengths, and a BandGroup's members.
[[nodiscard]] std::string band_piece_name(int group);
[[nodiscard]] PolyData band_piece(const SpectralSolution& spectral, const Bands& bands, int group);
[[nodiscard]] int read_band_count(vtkPolyData& piece, const Path& file);
/// Adds the group to those before it. `rgb` must be there.
void read_band_piece(vtkPolyData& piece, const Path& file, const Bands& bands, int group,
                     SpectralSolution& spectral);

}  // namespace transillum
