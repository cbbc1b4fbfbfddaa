/// NAME.vtm: the blocks of a solution, as VTK's multi-block reader wants them, with the size and
/// checksum of every file so that damage is found before anything is believed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace transillum {

struct IndexedPiece {
    std::string name;  ///< of the block; its file is FOLDER/name.vtp
    std::uint64_t bytes = 0;
    std::uint32_t checksum = 0;
};

struct IndexFile {
    std::string folder;  ///< beside the index file
    std::vector<IndexedPiece> pieces;
};

[[nodiscard]] IndexFile index_of(const std::string& folder,
                                 const std::vector<std::pair<std::string, std::string>>& pieces);

[[nodiscard]] std::string format_index(const IndexFile& index);

/// \param path of the index file, for messages.
/// \throws InputError unless `text` is what format_index makes, of a format this program reads.
[[nodiscard]] IndexFile parse_index(const std::string& text, const std::filesystem::path& path);

}  // namespace transillum
