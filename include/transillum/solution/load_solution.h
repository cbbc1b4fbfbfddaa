/// Reads what save_solution wrote.
#pragma once

#include <transillum/solution/save_solution.h>
#include <transillum/solution/solution.h>

#include <filesystem>

namespace transillum {

/// \throws InputError naming the file and array when it is truncated, corrupt, foreign, or of
/// another format; IoError when it cannot be read. Values are checked: finite, in range, indices
/// within bounds.
[[nodiscard]] Solution load_solution(const std::filesystem::path& path);

/// The record that lies beside a solution; empty where there is none.
[[nodiscard]] RunRecord load_run_record(const std::filesystem::path& path);

}  // namespace transillum
