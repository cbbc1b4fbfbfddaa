#include <transillum/base/error.h>
#include <transillum/base/glb.h>

#include <bit>
#include <cstdint>
#include <limits>

namespace transillum {

namespace {

static_assert(std::endian::native == std::endian::little);
constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;

void append(std::string& bytes, std::uint32_t value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_chunk(std::string& bytes, std::uint32_t type, const std::string& chunk) {
    append(bytes, static_cast<std::uint32_t>(chunk.size()));
    append(bytes, type);
    bytes += chunk;
}

}  // namespace

std::string glb_bytes(std::string json, std::string binary, const std::filesystem::path& file) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const std::uint64_t size = 12 + 8 + json.size() + 8 + binary.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw InputError(file.string(), std::to_string(size) +
                                            " bytes; accepted by .glb: below 4 GiB, and more by "
                                            "other formats");
    std::string bytes = "glTF";
    append(bytes, 2);
    append(bytes, static_cast<std::uint32_t>(size));
    append_chunk(bytes, json_chunk, json);
    append_chunk(bytes, binary_chunk, binary);
    return bytes;
}

}  // namespace transillum
