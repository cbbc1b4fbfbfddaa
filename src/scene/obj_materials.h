/// The materials an OBJ file names, and the libraries that define them.
#pragma once

#include "scene/obj_textures.h"
#include "scene/read_mtl.h"
#include "scene/text_reader.h"

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace transillum {

class ObjMaterials {
public:
    ObjMaterials(std::filesystem::path obj, Monitor& monitor)
        : obj_(std::move(obj)), textures_(obj_.parent_path(), monitor), monitor_(monitor) {}

    /// The libraries of an `mtllib` statement; one that is not there is warned of.
    void load(const TextReader& statement);
    /// `usemtl`; without a name, the default material.
    void select(std::string_view name) { selected_ = name; }
    /// Number of the selected name, for Polygon::material until `finish`.
    std::uint32_t current();
    /// Fills in the scene's materials: those of the libraries, then a default one for each name
    /// that none defines; reads the textures of those used and places their texture coordinates.
    /// \throws InputError where such a texture cannot be read.
    void finish(Scene& scene);

private:
    bool load_library(const std::string& name);
    std::uint32_t index_of(const std::string& name, Scene& scene);
    void place_uvs(Scene& scene) const;

    std::filesystem::path obj_;
    ObjTextures textures_;
    Monitor& monitor_;
    std::string selected_;
    std::map<std::string, std::uint32_t, std::less<>> number_of_name_;
    std::vector<std::string> names_;
    std::vector<MtlMaterial> library_;
};

}  // namespace transillum
