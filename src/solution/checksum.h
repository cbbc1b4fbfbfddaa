/// CRC-32 (ISO 3309, as in zip and PNG): finds every change of up to 32 neighbouring bits.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace transillum {

[[nodiscard]] constexpr std::array<std::uint32_t, 256> crc32_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t rest = byte;
        for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ (rest & 1 ? 0xedb88320u : 0u);
        table[byte] = rest;
    }
    return table;
}

[[nodiscard]] constexpr std::uint32_t crc32(std::string_view bytes) {
    constexpr auto table = crc32_table();
    std::uint32_t crc = 0xffffffffu;
    for (const char c : bytes)
        crc = (crc >> 8) ^ table[(crc ^ static_cast<unsigned char>(c)) & 255];
    return ~crc;
}

static_assert(crc32("123456789") == 0xcbf43926u);

}  // namespace transillum
