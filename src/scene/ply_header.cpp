#include "scene/ply_header.h"

#include "scene/text_reader.h"

#include <transillum/base/error.h>

#include <algorithm>
#include <array>
#include <utility>

namespace transillum {

namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};

constexpr std::array<TypeName, 16> type_names{{{"char", PlyType::int8},
                                               {"int8", PlyType::int8},
                                               {"uchar", PlyType::uint8},
                                               {"uint8", PlyType::uint8},
                                               {"short", PlyType::int16},
                                               {"int16", PlyType::int16},
                                               {"ushort", PlyType::uint16},
                                               {"uint16", PlyType::uint16},
                                               {"int", PlyType::int32},
                                               {"int32", PlyType::int32},
                                               {"uint", PlyType::uint32},
                                               {"uint32", PlyType::uint32},
                                               {"float", PlyType::float32},
                                               {"float32", PlyType::float32},
                                               {"double", PlyType::float64},
                                               {"float64", PlyType::float64}}};

constexpr std::size_t most_properties = 1000;

PlyType read_type(const TextReader& reader, std::string_view word) {
    for (const TypeName& t : type_names)
        if (t.name == word) return t.type;
    reader.fail("type " + in_quotes(word) +
                " found; accepted: char uchar short ushort int uint float double");
}

PlyFormat read_format(const TextReader& reader) {
    constexpr std::array<std::string_view, 3> names{"ascii", "binary_little_endian",
                                                    "binary_big_endian"};
    const auto& words = reader.words();
    if (words.size() == 3 && words[2] == "1.0")
        for (std::size_t i = 0; i < names.size(); ++i)
            if (words[1] == names[i]) return static_cast<PlyFormat>(i);
    reader.fail(
        in_quotes(reader.rest(0)) +
        " found; accepted: format ascii, binary_little_endian or binary_big_endian, version 1.0");
}

PlyElement read_element(const TextReader& reader) {
    const auto& words = reader.words();
    if (words.size() != 3)
        reader.fail(in_quotes(reader.rest(0)) + " found; accepted: element NAME COUNT");
    const std::int64_t count = reader.integer(words[2]);
    if (count < 0) reader.fail("count " + std::to_string(count) + " found; accepted: 0 or more");
    return {std::string(words[1]), static_cast<std::uint64_t>(count), {}};
}

PlyProperty read_property(const TextReader& reader) {
    const auto& words = reader.words();
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3)
        reader.fail(in_quotes(reader.rest(0)) + " found; accepted: property [list TYPE] TYPE NAME");
    PlyProperty property{
        std::string(words.back()), read_type(reader, words[words.size() - 2]), is_list, {}};
    if (is_list) property.count_type = read_type(reader, words[2]);
    return property;
}

/// So that no count in a damaged header makes the reader ask for more memory than the file could
/// fill.
void check_count(const std::string& path, const PlyElement& element, PlyFormat format,
                 std::uint64_t file_size) {
    const std::string where = path + ": element " + in_quotes(element.name);
    if (element.properties.empty())
        throw InputError(where, "has no property; accepted: one or more");
    std::uint64_t least = 0;
    for (const PlyProperty& p : element.properties)
        least += format == PlyFormat::ascii ? 2 : size_of(p.is_list ? p.count_type : p.type);
    const std::uint64_t most = (file_size + 1) / least;
    if (element.count > most)
        throw InputError(where, std::to_string(element.count) + " announced; accepted: at most " +
                                    std::to_string(most) + " in a file of " +
                                    std::to_string(file_size) + " bytes");
}

}  // namespace

std::size_t size_of(PlyType type) {
    constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

PlyHeader read_ply_header(const std::string& path, std::string_view bytes) {
    constexpr std::string_view last = "\nend_header";
    const std::size_t end = bytes.find(last);
    const std::size_t line_end =
        end == std::string_view::npos ? end : bytes.find('\n', end + last.size());
    if (!bytes.starts_with("ply") || line_end == std::string_view::npos)
        throw InputError(path, "not a whole PLY header; accepted: ply ... end_header");

    PlyHeader header;
    bool has_format = false;
    TextReader reader(path, bytes.substr(0, end + 1), {.comments = false});
    reader.next_line();
    while (reader.next_line()) {
        const std::string_view keyword = reader.words()[0];
        if (keyword == "comment" || keyword == "obj_info") continue;
        if (keyword == "format") {
            header.format = read_format(reader);
            has_format = true;
        } else if (keyword == "element") {
            header.elements.push_back(read_element(reader));
        } else if (keyword == "property" && !header.elements.empty()) {
            auto& properties = header.elements.back().properties;
            if (properties.size() == most_properties)
                reader.fail("more than " + std::to_string(most_properties) +
                            " properties of an element; accepted: fewer");
            properties.push_back(read_property(reader));
            if (std::ranges::count(properties, properties.back().name, &PlyProperty::name) > 1)
                reader.fail("property " + in_quotes(properties.back().name) +
                            " comes twice; accepted: once");
        } else {
            reader.fail(in_quotes(keyword) +
                        " found; accepted: format, element, property (of an element), comment");
        }
    }
    if (!has_format)
        reader.fail(
            "no format in the header; accepted: ascii, binary_little_endian, binary_big_endian");
    for (const PlyElement& element : header.elements)
        check_count(path, element, header.format, bytes.size());
    header.body_offset = line_end + 1;
    header.body_line = reader.line() + 2;
    return header;
}

}  // namespace transillum
