/// NAME.vtm: the blocks of a solution, as VTK's multi-block reader wants them, with the size and
/// checksum of every file so that damage is found before anything is believed. Images, groups of
/// bands, emitters and sums stand beside the blocks, where viewers do not put them into the scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace transillum {

struct IndexedPiece {
    std::string name;  ///< of the block; its file is FOLDER/file_of_piece(name)
    std::uint64_t bytes = 0;
    std::uint32_t checksum = 0;
};

struct IndexFile {
    std::string folder;  ///< beside the index file
    std::vector<IndexedPiece> pieces;
};

[[nodiscard]] bool is_image(std::string_view piece);
[[nodiscard]] bool is_band_group(std::string_view piece);
[[nodiscard]] bool is_emitter(std::string_view piece);
[[nodiscard]] bool is_sums(std::string_view piece);
/// The name with its extension: .vti for images, .vtp for all else.
[[nodiscard]] std::string file_of_piece(std::string_view piece);

[[nodiscard]] IndexFile index_of(const std::string& folder,
                                 const std::vector<std::pair<std::string, std::string>>& pieces);

[[nodiscard]] std::string format_index(const IndexFile& index);

/// \param path of the index file, for messages.
/// \throws InputError unless `text` is what format_index makes, of a format this program reads.
[[nodiscard]] IndexFile parse_index(const std::string& text, const std::filesystem::path& path);

}  // namespace transillum
