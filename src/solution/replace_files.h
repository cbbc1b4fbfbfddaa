/// Puts the files of a solution where an older one may lie: all of them or none.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace transillum {

struct SolutionFiles {
    std::string index;                                        ///< bytes of NAME.vtm
    std::vector<std::pair<std::string, std::string>> pieces;  ///< bytes of NAME/first
};

/// Writes everything into a temporary folder beside `path`, then renames; NAME.vtm comes last.
/// \throws IoError where it cannot, or where NAME/ holds files that are none of a solution's;
/// everything is then as it was before.
void replace_files(const SolutionFiles& files, const std::filesystem::path& path);

/// \throws IoError
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path);

}  // namespace transillum
