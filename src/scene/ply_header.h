/// The header of a PLY file (Turk 1994): which elements follow, and how their values are stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace transillum {

enum class PlyFormat { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes a value takes in the binary formats.
[[nodiscard]] std::size_t size_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type{};  ///< of the value, or of each in a list
    bool is_list = false;
    PlyType count_type{};  ///< of a list's length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format{};
    std::vector<PlyElement> elements;
    std::size_t body_offset = 0;  ///< where the values begin [bytes]
    std::size_t body_line = 0;    ///< and the number of that line
};

/// \throws InputError naming `path` and line; also where the counts cannot fit into `bytes`.
[[nodiscard]] PlyHeader read_ply_header(const std::string& path, std::string_view bytes);

}  // namespace transillum
