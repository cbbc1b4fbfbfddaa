#include "scene/gltf_builder.h"

#include <transillum/base/error.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

namespace transillum {

namespace {

static_assert(std::endian::native == std::endian::little);

/// As a reference within a URI.
std::string encode_percent(const std::string& name) {
    constexpr std::string_view unreserved =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~";
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string uri;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (unreserved.find(c) != std::string_view::npos) {
            uri += c;
        } else {
            uri += {'%', digits[byte >> 4], digits[byte & 15]};
        }
    }
    return uri;
}

void append(std::string& bytes, std::uint32_t value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

GltfBuilder::GltfBuilder(const SceneWriter& writer, GltfContainer container)
    : writer_(writer), container_(container) {
    root_["asset"] = {{"version", "2.0"}, {"generator", "transillum"}};
}

std::size_t GltfBuilder::add(const char* array, Json element) {
    Json& elements = root_[array];
    elements.push_back(std::move(element));
    return elements.size() - 1;
}

std::size_t GltfBuilder::add_view(std::string_view bytes, int target) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    Json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    bytes_ += bytes;
    return add("bufferViews", std::move(view));
}

std::size_t GltfBuilder::add_image(const std::string& png) {
    if (container_ == GltfContainer::binary)
        return add("images", {{"bufferView", add_view(png)}, {"mimeType", "image/png"}});
    const std::string file = writer_.stem() + "-texture-" + std::to_string(++images_) + ".png";
    writer_.files.write(file, png);
    return add("images", {{"uri", encode_percent(file)}});
}

GltfBuilder::Json& GltfBuilder::extension(const char* name) {
    use_extension(name);
    return root_["extensions"][name];
}

void GltfBuilder::write_binary(const std::string& text) {
    constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
    const auto padded = [](std::string bytes, char with) {
        bytes.resize((bytes.size() + 3) / 4 * 4, with);
        return bytes;
    };
    const std::string json = padded(text, ' '), binary = padded(bytes_, '\0');
    const std::uint64_t size = 12 + 8 + json.size() + 8 + binary.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw InputError(writer_.files.main().string(),
                         std::to_string(size) +
                             " bytes; accepted by .glb: below 4 GiB, "
                             "and more by .gltf");
    std::string bytes = "glTF";
    append(bytes, 2);
    append(bytes, static_cast<std::uint32_t>(size));
    append(bytes, static_cast<std::uint32_t>(json.size()));
    append(bytes, json_chunk);
    bytes += json;
    append(bytes, static_cast<std::uint32_t>(binary.size()));
    append(bytes, binary_chunk);
    bytes += binary;
    writer_.files.write_main(bytes);
}

void GltfBuilder::finish() {
    if (!extensions_.empty()) root_["extensionsUsed"] = extensions_;
    Json buffer{{"byteLength", bytes_.size()}};
    const std::string file = writer_.stem() + ".bin";
    if (container_ == GltfContainer::json) buffer["uri"] = encode_percent(file);
    add("buffers", std::move(buffer));
    // Names from other formats may be in another encoding than UTF-8.
    constexpr auto replace = Json::error_handler_t::replace;
    if (container_ == GltfContainer::binary)
        return write_binary(root_.dump(-1, ' ', false, replace));
    writer_.files.write(file, bytes_);
    writer_.files.write_main(root_.dump(1, ' ', false, replace) + "\n");
}

}  // namespace transillum
