#include "scene/gltf_document.h"

#include "scene/soup.h"
#include "scene/text_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

namespace transillum {

namespace {

static_assert(std::endian::native == std::endian::little);

std::uint32_t read_uint32(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

std::size_t component_size(int type) {
    switch (type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

int component_count(std::string_view type) {
    constexpr std::array<std::string_view, 4> types{"SCALAR", "VEC2", "VEC3", "VEC4"};
    for (std::size_t i = 0; i < types.size(); ++i)
        if (types[i] == type) return static_cast<int>(i) + 1;
    return 0;
}

template <class T>
double decode(const char* at, bool normalized) {
    T value;
    std::memcpy(&value, at, sizeof value);
    if (!normalized) return static_cast<double>(value);
    return std::max(static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max()),
                    -1.0);
}

int hexadecimal(char c) {
    constexpr std::string_view digits = "0123456789abcdefABCDEF";
    const std::size_t i = digits.find(c);
    return i == std::string_view::npos ? -1 : static_cast<int>(i < 16 ? i : i - 6);
}

std::string decode_percent(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escape = uri[i] == '%' && i + 2 < uri.size() && hexadecimal(uri[i + 1]) >= 0 &&
                            hexadecimal(uri[i + 2]) >= 0;
        text += escape ? static_cast<char>(hexadecimal(uri[i + 1]) * 16 + hexadecimal(uri[i + 2]))
                       : uri[i];
        if (escape) i += 2;
    }
    return text;
}

/// What handles JSON goes down into it by recursion.
void check_nesting(const std::filesystem::path& path, std::string_view text) {
    constexpr std::size_t deepest = 100;
    std::size_t depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string && c == '\\') {
            ++i;
        } else if (c == '"') {
            in_string = !in_string;
        } else if (!in_string && (c == '[' || c == '{')) {
            if (++depth > deepest)
                throw InputError(
                    path.string() + ": byte " + std::to_string(i),
                    "JSON nested more than " + std::to_string(deepest) + " deep; accepted: less");
        } else if (!in_string && (c == ']' || c == '}') && depth > 0) {
            --depth;
        }
    }
}

}  // namespace

double GltfAccessor::value(std::size_t element, int component) const {
    const char* at = bytes.data() + element * stride +
                     static_cast<std::size_t>(component) * component_size(component_type);
    switch (component_type) {
        case 5120:
            return decode<std::int8_t>(at, normalized);
        case 5121:
            return decode<std::uint8_t>(at, normalized);
        case 5122:
            return decode<std::int16_t>(at, normalized);
        case 5123:
            return decode<std::uint16_t>(at, normalized);
        case 5125:
            return decode<std::uint32_t>(at, normalized);
        default:
            return decode<float>(at, false);
    }
}

std::string place_of(const char* array, std::size_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

std::string decode_data_uri(const std::string& where, std::string_view uri) {
    constexpr std::string_view mark = ";base64,";
    constexpr std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t begin = uri.find(mark);
    if (begin == std::string_view::npos)
        throw InputError(where, in_quotes(uri) + " found; accepted: base64 data");
    std::string_view digits = uri.substr(begin + mark.size());
    while (digits.ends_with('=')) digits.remove_suffix(1);
    std::array<int, 256> value_of;
    value_of.fill(-1);
    for (std::size_t i = 0; i < alphabet.size(); ++i)
        value_of[static_cast<unsigned char>(alphabet[i])] = static_cast<int>(i);

    std::string bytes;
    bytes.reserve(digits.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : digits) {
        const int value = value_of[static_cast<unsigned char>(c)];
        if (value < 0)
            throw InputError(where, "base64 data with the character " + in_quotes({&c, 1}) +
                                        "; accepted: A-Z a-z 0-9 + /");
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xff);
    }
    return bytes;
}

std::size_t size_value(const GltfDocument& document, const Json& object, const char* key,
                       std::size_t fallback) {
    const auto found = object.find(key);
    if (found == object.end()) return fallback;
    if (!found->is_number_unsigned())
        document.fail(key, in_quotes(found->dump()) + " found; accepted: 0 or more, whole");
    return found->get<std::size_t>();
}

void GltfDocument::fail(const std::string& place, const std::string& what) const {
    throw InputError(path_.string() + ": " + place, what);
}

GltfDocument::GltfDocument(const std::filesystem::path& path) : path_(path) {
    const std::string bytes = read_file(path);
    if (bytes.starts_with("glTF")) {
        read_glb(bytes);
    } else {
        parse(bytes);
    }
    check_version();
    read_buffers();
}

void GltfDocument::parse(std::string_view text) {
    check_nesting(path_, text);
    try {
        root_ = Json::parse(text);
    } catch (const Json::exception& error) {
        throw InputError(path_.string(), "not JSON: " + in_quotes(error.what()));
    }
    if (!root_.is_object())
        throw InputError(path_.string(), "not a JSON object; accepted: glTF 2.0");
}

void GltfDocument::read_glb(const std::string& bytes) {
    constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
    const std::string size = std::to_string(bytes.size());
    if (bytes.size() < 20) fail("header", "the file has " + size + " bytes; accepted: 20 or more");
    if (read_uint32(bytes, 4) != 2)
        fail("header",
             "container version " + std::to_string(read_uint32(bytes, 4)) + "; accepted: 2");
    if (read_uint32(bytes, 8) != bytes.size())
        fail("header",
             "says " + std::to_string(read_uint32(bytes, 8)) + " bytes, the file has " + size);
    bool has_json = false;
    for (std::size_t at = 12; at < bytes.size();) {
        const std::size_t left = bytes.size() - at;
        if (left < 8 || read_uint32(bytes, at) > left - 8)
            fail("byte " + std::to_string(at),
                 "a chunk runs past the end of the file, which has " + size + " bytes");
        const std::string_view chunk =
            std::string_view(bytes).substr(at + 8, read_uint32(bytes, at));
        const std::uint32_t type = read_uint32(bytes, at + 4);
        if (!has_json && type != json_chunk)
            fail("byte " + std::to_string(at), "not a JSON chunk; accepted: JSON first");
        if (!has_json) {
            parse(chunk);
            has_json = true;
        } else if (type == binary_chunk && !has_binary_chunk_) {
            binary_chunk_ = chunk;
            has_binary_chunk_ = true;
        }
        at += 8 + chunk.size();
    }
}

void GltfDocument::check_version() const {
    const std::string version = root_.at("asset").at("version").get<std::string>();
    if (!version.starts_with("2."))
        fail("asset", "glTF version " + in_quotes(version) + "; accepted: 2.0");
}

void GltfDocument::read_buffers() {
    for (std::size_t i = 0; i < count("buffers"); ++i)
        buffers_.push_back(read_buffer(root_.at("buffers")[i], i));
}

std::string_view GltfDocument::read_buffer(const Json& buffer, std::size_t number) {
    const std::string place = place_of("buffers", number);
    const std::size_t length = size_value(*this, buffer, "byteLength", 0);
    std::string_view bytes;
    if (!buffer.contains("uri")) {
        if (number != 0 || !has_binary_chunk_)
            fail(place, "no uri and no binary chunk; accepted: either");
        bytes = binary_chunk_;
    } else if (const auto uri = buffer.at("uri").get<std::string>(); uri.starts_with("data:")) {
        bytes = decoded_.emplace_back(decode_data_uri(path_.string() + ": " + place, uri));
    } else {
        std::error_code ignored;
        const std::filesystem::path file = file_of(uri);
        if (!std::filesystem::is_regular_file(file, ignored))
            fail(place, "its file " + in_quotes(file.string()) + " is not there");
        const auto [found, is_new] =
            files_.try_emplace(std::filesystem::weakly_canonical(file, ignored).string());
        if (is_new) found->second = read_file(file);
        bytes = found->second;
    }
    if (bytes.size() < length)
        fail(place, "says " + std::to_string(length) + " bytes, but there are " +
                        std::to_string(bytes.size()));
    return bytes.substr(0, length);
}

std::filesystem::path GltfDocument::file_of(const std::string& uri) const {
    return path_.parent_path() / decode_percent(uri);
}

std::size_t GltfDocument::count(const char* array) const {
    const auto found = root_.find(array);
    if (found == root_.end()) return 0;
    if (!found->is_array()) fail(array, "is no array; accepted: an array");
    return found->size();
}

std::size_t GltfDocument::index_into(const char* array, const Json& index) const {
    if (!index.is_number_unsigned() || index.get<std::size_t>() >= count(array))
        fail(array, "element " + in_quotes(index.dump()) + " is named of " +
                        std::to_string(count(array)) + "; accepted: " + index_range(count(array)));
    return index.get<std::size_t>();
}

const Json& GltfDocument::element(const char* array, const Json& index) const {
    const std::size_t i = index_into(array, index);
    return root_.at(array)[i];
}

std::string_view GltfDocument::buffer_view(const Json& index) const {
    const Json& view = element("bufferViews", index);
    const std::string_view buffer = buffers_[index_into("buffers", view.at("buffer"))];
    const std::size_t offset = size_value(*this, view, "byteOffset", 0);
    const std::size_t length = size_value(*this, view, "byteLength", 0);
    if (offset > buffer.size() || length > buffer.size() - offset)
        fail(place_of("bufferViews", index.get<std::size_t>()),
             std::to_string(length) + " bytes from " + std::to_string(offset) +
                 " on; its buffer has " + std::to_string(buffer.size()));
    return buffer.substr(offset, length);
}

GltfAccessor GltfDocument::accessor(const Json& index, const char* type) const {
    const Json& json = element("accessors", index);
    const std::string place = place_of("accessors", index.get<std::size_t>());
    if (json.contains("sparse") || !json.contains("bufferView"))
        fail(place, "is sparse or has no bufferView; accepted: values in a bufferView");
    GltfAccessor result;
    result.component_type = static_cast<int>(size_value(*this, json, "componentType", 0));
    const std::size_t value_size = component_size(result.component_type);
    if (value_size == 0)
        fail(place, "componentType " + json.at("componentType").dump() +
                        "; accepted: 5120 to 5123, 5125, 5126");
    if (json.at("type").get<std::string>() != type)
        fail(place,
             "type " + in_quotes(json.at("type").get<std::string>()) + "; accepted: " + type);
    result.components = component_count(type);
    result.normalized = json.value("normalized", false);
    result.count = size_value(*this, json, "count", 0);

    const std::string_view view = buffer_view(json.at("bufferView"));
    const std::size_t element_size = value_size * static_cast<std::size_t>(result.components);
    const Json& view_json = element("bufferViews", json.at("bufferView"));
    result.stride = size_value(*this, view_json, "byteStride", element_size);
    const std::size_t offset = size_value(*this, json, "byteOffset", 0);
    const bool begins_within = offset <= view.size() && result.stride >= element_size;
    const std::size_t room =
        begins_within ? view.size() - offset + (result.stride - element_size) : 0;
    if (!begins_within || result.count > room / result.stride)
        fail(place, std::to_string(result.count) + " elements from byte " + std::to_string(offset) +
                        " on, " + std::to_string(result.stride) +
                        " bytes apart; its bufferView has " + std::to_string(view.size()) +
                        " bytes");
    result.bytes = view.substr(offset);
    return result;
}

}  // namespace transillum
