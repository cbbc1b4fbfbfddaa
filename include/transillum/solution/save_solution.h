/// Solution files: VTK XML, readable by ParaView and any VTK program.
///
/// - NAME.vtm: written last and atomically: the index; its presence says the solution is whole
/// - NAME/radiance.vtp: one cell a patch that reflects or emits and is not dark throughout its
///   root's side
/// - NAME/incoming.vtp: per patch and light sample: what arrives by first shot (absent without
///   light samples)
/// - NAME/lights.vtp: the light samples, lights without extent and environment
/// - NAME/environment.vtp: the environment's image (absent without)
/// - NAME/surface.vtp: the root triangles
/// - NAME/texture-N.vti: the textures that materials name
/// - NAME/bands-NN.vtp: of a solution in bands of wavelengths, a group of three (absent without)
/// - NAME/emitter-NN.vtp: what comes of the light of one emitter (absent unless kept)
/// - NAME/sums.vtp: what a bake needs to go on (absent unless the solution holds it)
/// - NAME/run.json: timings, threads, command line: all that may differ between two equal solutions
#pragma once

#include <transillum/solution/emitter_solution.h>
#include <transillum/solution/solution.h>
#include <transillum/solution/spectral_solution.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace transillum {

inline constexpr int solution_format_version = 3;

/// Facts of one run, kept beside the solution because they are no part of it.
struct RunRecord {
    std::string command_line;
    int threads = 0;
    std::vector<std::pair<std::string, double>> seconds;  ///< wall time by phase
    /// Of the scene as it was read, and of the options: baked again they give this solution. Empty
    /// where it is not to be found again, as of bands.
    std::string input_hash{};
};

/// Writes into a temporary folder beside the target and renames; an older solution of that name
/// stays whole until then. Bytes of the VTK files depend on the solution alone. Of a side that is
/// dark throughout nothing is kept: it loads with zeros, coverage and visibility among them.
/// \throws UsageError unless `path` ends in .vtm; Error where the solution contradicts itself or
/// holds a value that is not finite or out of range; IoError where it cannot write, or where NAME
/// is a folder with files that are none of a solution's. Nothing is left behind then, and nothing
/// changed.
void save_solution(const Solution& solution, const RunRecord& run,
                   const std::filesystem::path& path);

/// The same, with the light of each emitter beside it.
void save_emitter_solution(const EmitterSolution& solution, const RunRecord& run,
                           const std::filesystem::path& path);

/// The same, with the groups of bands beside it. What viewers show as radiance is that of the
/// groups, converted to linear sRGB, with negative values where it lies outside.
/// \pre as many groups as the bands make up.
void save_spectral_solution(const SpectralSolution& spectral, const RunRecord& run,
                            const std::filesystem::path& path);

}  // namespace transillum
