#include "index_file.h"

#include "checksum.h"

#include <transillum/base/error.h>
#include <transillum/solution/save_solution.h>

#include <array>
#include <charconv>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

namespace transillum {

namespace {

constexpr std::string_view format_attribute = "transillum_format";

constexpr std::array<std::pair<char, std::string_view>, 5> xml_entities{
    {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&apos;"}}};

std::string escape_xml(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        std::string_view piece(&c, 1);
        for (const auto& [plain, entity] : xml_entities) {
            if (c == plain) piece = entity;
        }
        escaped += piece;
    }
    return escaped;
}

std::string unescape_xml(std::string_view text) {
    std::string plain;
    while (!text.empty()) {
        char c = text.front();
        std::size_t length = 1;
        for (const auto& [character, entity] : xml_entities) {
            if (text.starts_with(entity)) {
                c = character;
                length = entity.size();
            }
        }
        plain += c;
        text.remove_prefix(length);
    }
    return plain;
}

/// Value of the first attribute of that name in `text`.
std::optional<std::string> attribute(std::string_view text, std::string_view name) {
    const std::string opening = std::string(" ").append(name).append("=\"");
    const std::size_t begin = text.find(opening);
    if (begin == std::string_view::npos) return std::nullopt;
    text.remove_prefix(begin + opening.size());
    const std::size_t end = text.find('"');
    if (end == std::string_view::npos) return std::nullopt;
    return unescape_xml(text.substr(0, end));
}

template <class Number>
Number number_or_zero(const std::optional<std::string>& text, int base = 10) {
    Number number{};
    if (text) std::from_chars(text->data(), text->data() + text->size(), number, base);
    return number;
}

std::string hexadecimal(std::uint32_t number) {
    std::string digits(8, '0');
    for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, number >>= 4) {
        *digit = "0123456789abcdef"[number & 15];
    }
    return digits;
}

/// Empty for a block.
const char* element_beside_blocks(std::string_view piece) {
    if (is_image(piece)) return "Image";
    if (is_band_group(piece)) return "Bands";
    if (is_emitter(piece)) return "Emitter";
    return is_sums(piece) ? "Sums" : "";
}

void check_format(const std::string& text, const std::filesystem::path& path) {
    const auto format = attribute(text, format_attribute);
    if (!format) {
        throw InputError(path.string(), "not a transillum solution (no attribute " +
                                            std::string(format_attribute) +
                                            "; a .vtm of another program?)");
    }
    if (number_or_zero<int>(format) != solution_format_version) {
        throw InputError(path.string(), "written by format " + *format +
                                            ", this program reads format " +
                                            std::to_string(solution_format_version));
    }
}

}  // namespace

bool is_image(std::string_view piece) {
    return piece.starts_with("texture-");
}

bool is_band_group(std::string_view piece) {
    return piece.starts_with("bands-");
}

bool is_emitter(std::string_view piece) {
    return piece.starts_with("emitter-");
}

bool is_sums(std::string_view piece) {
    return piece == "sums";
}

std::string file_of_piece(std::string_view piece) {
    return std::string(piece) + (is_image(piece) ? ".vti" : ".vtp");
}

IndexFile index_of(const std::string& folder,
                   const std::vector<std::pair<std::string, std::string>>& pieces) {
    IndexFile index{folder, {}};
    for (const auto& [name, bytes] : pieces) {
        index.pieces.push_back({name, bytes.size(), crc32(bytes)});
    }
    return index;
}

std::string format_index(const IndexFile& index) {
    std::ostringstream text;
    const auto attributes_of = [&](const IndexedPiece& piece) {
        text << "name=\"" << piece.name << "\" file=\"" << escape_xml(index.folder) << '/'
             << file_of_piece(piece.name) << "\" bytes=\"" << piece.bytes << "\" crc32=\""
             << hexadecimal(piece.checksum) << "\"/>\n";
    };
    text << "<?xml version=\"1.0\"?>\n"
         << "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\""
         << " header_type=\"UInt64\">\n"
         << "  <vtkMultiBlockDataSet " << format_attribute << "=\"" << solution_format_version
         << "\">\n";
    std::size_t block = 0;
    for (const IndexedPiece& piece : index.pieces) {
        if (*element_beside_blocks(piece.name) != 0) continue;
        text << "    <DataSet index=\"" << block++ << "\" ";
        attributes_of(piece);
    }
    text << "  </vtkMultiBlockDataSet>\n";
    for (const IndexedPiece& piece : index.pieces) {
        const char* const element = element_beside_blocks(piece.name);
        if (*element == 0) continue;
        text << "  <" << element << ' ';
        attributes_of(piece);
    }
    text << "</VTKFile>\n";
    return text.str();
}

IndexFile parse_index(const std::string& text, const std::filesystem::path& path) {
    check_format(text, path);
    IndexFile index;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.find("<DataSet ") == std::string::npos &&
            line.find("<Image ") == std::string::npos &&
            line.find("<Bands ") == std::string::npos && line.find("<Sums ") == std::string::npos &&
            line.find("<Emitter ") == std::string::npos)
            continue;
        const std::string file = attribute(line, "file").value_or("");
        index.folder = file.substr(0, file.find('/'));
        index.pieces.push_back({attribute(line, "name").value_or(""),
                                number_or_zero<std::uint64_t>(attribute(line, "bytes")),
                                number_or_zero<std::uint32_t>(attribute(line, "crc32"), 16)});
    }
    // What was understood must account for every byte, so no damage goes unseen.
    if (format_index(index) != text) {
        throw InputError(path.string(), "the index is truncated, damaged or edited");
    }
    return index;
}

}  // namespace transillum
