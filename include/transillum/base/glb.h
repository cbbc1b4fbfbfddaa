/// The container of glTF 2.0's binary files (specification, §4.4).
#pragma once

#include <filesystem>
#include <string>

namespace transillum {

/// \param binary the buffer without a URI
/// \param file where it is meant to go, for messages
/// \throws InputError where the bytes are more than the format holds: 4 GiB
[[nodiscard]] std::string glb_bytes(std::string json, std::string binary,
                                    const std::filesystem::path& file);

}  // namespace transillum
