/// Reads what save_solution wrote; what a bake needs to go on, only where that is asked for.
#pragma once

#include <transillum/solution/emitter_solution.h>
#include <transillum/solution/save_solution.h>
#include <transillum/solution/solution.h>
#include <transillum/solution/spectral_solution.h>

#include <filesystem>
#include <optional>
#include <string>

namespace transillum {

/// \throws InputError naming the file and array when it is truncated, corrupt, foreign, or of
/// another format; IoError when it cannot be read. Values are checked: finite, in range, indices
/// within bounds.
[[nodiscard]] Solution load_solution(const std::filesystem::path& path);

/// The finished solution that lies at `path` if it was baked from this input; nothing where there
/// is none, it was interrupted, is damaged or of another input or format. \pre hash not empty
[[nodiscard]] std::optional<Solution> find_baked(const std::filesystem::path& path,
                                                 const std::string& input_hash);

/// With its groups of bands; without any where it was baked in RGB. \throws as load_solution, also
/// where groups are missing or are not of this solution.
[[nodiscard]] SpectralSolution load_spectral_solution(const std::filesystem::path& path);

/// With what another bake needs to go on from it. \throws as load_solution, also where the file has
/// none: it was not kept, or it is a solution in bands.
[[nodiscard]] Solution load_solution_to_go_on(const std::filesystem::path& path);

/// With the light of each emitter. \throws as load_solution, also where the file has none.
[[nodiscard]] EmitterSolution load_emitter_solution(const std::filesystem::path& path);

/// The record that lies beside a solution; empty where there is none.
[[nodiscard]] RunRecord load_run_record(const std::filesystem::path& path);

}  // namespace transillum
