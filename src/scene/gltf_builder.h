/// The JSON and the bytes of a glTF 2.0 file while it is put together.
#pragma once

#include "scene/scene_writer.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace transillum {

enum class GltfContainer { json, binary };

class GltfBuilder {
public:
    using Json = nlohmann::json;

    GltfBuilder(const SceneWriter& writer, GltfContainer container);

    [[nodiscard]] const SceneWriter& writer() const { return writer_; }
    /// Appends to a top-level array; returns the element's index.
    std::size_t add(const char* array, Json element);
    /// Appends bytes to the buffer; returns the index of their view.
    std::size_t add_view(std::string_view bytes, int target = 0);
    /// Adds an image, as a file beside the main one or as a view; returns its index.
    std::size_t add_image(const std::string& png);
    void use_extension(const char* name) { extensions_.insert(name); }
    /// An object under the file's extensions, made where it is not there yet.
    Json& extension(const char* name);

    /// Stages the files. \throws InputError where the bytes are more than the format holds.
    void finish();

private:
    const SceneWriter& writer_;
    GltfContainer container_;
    Json root_;
    std::string bytes_;
    std::set<std::string> extensions_;
    std::size_t images_ = 0;
};

}  // namespace transillum
