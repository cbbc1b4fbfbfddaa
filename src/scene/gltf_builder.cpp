#include "scene/gltf_builder.h"

#include <transillum/base/glb.h>

#include <utility>

namespace transillum {

namespace {

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

void GltfBuilder::finish() {
    if (!extensions_.empty()) root_["extensionsUsed"] = extensions_;
    Json buffer{{"byteLength", bytes_.size()}};
    const std::string file = writer_.stem() + ".bin";
    if (container_ == GltfContainer::json) buffer["uri"] = encode_percent(file);
    add("buffers", std::move(buffer));
    // Names from other formats may be in another encoding than UTF-8.
    constexpr auto replace = Json::error_handler_t::replace;
    if (container_ == GltfContainer::binary)
        return writer_.files.write_main(glb_bytes(root_.dump(-1, ' ', false, replace),
                                                  std::move(bytes_), writer_.files.main()));
    writer_.files.write(file, bytes_);
    writer_.files.write_main(root_.dump(1, ' ', false, replace) + "\n");
}

}  // namespace transillum
