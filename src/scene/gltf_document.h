/// The JSON and the buffers of a glTF 2.0 file, with every index and every byte range checked.
#pragma once

// Makes the library's messages name the place, as "/meshes/0/primitives".
#define JSON_DIAGNOSTICS 1
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace transillum {

using Json = nlohmann::json;

/// Elements of a typed array within a buffer.
struct GltfAccessor {
    std::string_view bytes;  ///< from the first element to the end of its view
    std::size_t count = 0, stride = 0;
    int component_type = 0;  ///< glTF's number, as 5126 for float
    int components = 0;
    bool normalized = false;

    /// A component as it is, or mapped to [0, 1] or [-1, 1] where normalized.
    [[nodiscard]] double value(std::size_t element, int component) const;
};

/// \throws InputError naming file and place in every member; IoError from the constructor.
class GltfDocument {
public:
    explicit GltfDocument(const std::filesystem::path& path);
    GltfDocument(const GltfDocument&) = delete;
    GltfDocument& operator=(const GltfDocument&) = delete;

    [[nodiscard]] const Json& root() const { return root_; }
    /// The element of a top-level array that `index` names.
    [[nodiscard]] const Json& element(const char* array, const Json& index) const;
    /// `index` as the index of an element of a top-level array.
    [[nodiscard]] std::size_t index_into(const char* array, const Json& index) const;
    /// Number of elements of a top-level array; 0 where it is absent.
    [[nodiscard]] std::size_t count(const char* array) const;
    [[nodiscard]] std::string_view buffer_view(const Json& index) const;
    /// Elements of the glTF type `type`, as "VEC3".
    [[nodiscard]] GltfAccessor accessor(const Json& index, const char* type) const;
    /// The file an image or buffer names, relative to this one.
    [[nodiscard]] std::filesystem::path file_of(const std::string& uri) const;

    [[nodiscard]] std::string where() const { return path_.string(); }
    [[noreturn]] void fail(const std::string& place, const std::string& what) const;

private:
    void read_glb(const std::string& bytes);
    void parse(std::string_view text);
    void read_buffers();
    std::string_view read_buffer(const Json& buffer, std::size_t number);
    void check_version() const;

    std::filesystem::path path_;
    Json root_;
    std::string binary_chunk_;
    bool has_binary_chunk_ = false;
    std::deque<std::string> decoded_;           ///< from data URIs
    std::map<std::string, std::string> files_;  ///< each read once, however many buffers name it
    std::vector<std::string_view> buffers_;
};

/// The bytes of a `data:` URI. \throws InputError in the name of `where`
[[nodiscard]] std::string decode_data_uri(const std::string& where, std::string_view uri);

/// "meshes[3]"
[[nodiscard]] std::string place_of(const char* array, std::size_t index);

/// A whole number of 0 or more under `key`, `fallback` where it is absent.
[[nodiscard]] std::size_t size_value(const GltfDocument& document, const Json& object,
                                     const char* key, std::size_t fallback);

}  // namespace transillum
