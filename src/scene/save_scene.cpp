#include <transillum/scene/save_scene.h>

#include "scene/scene_writer.h"
#include "scene/text_reader.h"

#include <transillum/base/error.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace transillum {

namespace {

struct Format {
    const char* extension;
    const char* name;
    bool polygons;
    void (*write)(const SceneWriter&);
};

constexpr std::array<Format, 6> formats{{{".gltf", "glTF", false, write_gltf},
                                         {".glb", "glTF", false, write_glb},
                                         {".obj", "OBJ", true, write_obj},
                                         {".ply", "PLY", true, write_ply},
                                         {".stl", "STL", false, write_stl},
                                         {".off", "OFF", true, write_off}}};

const Format& format_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    for (const Format& f : formats)
        if (extension == f.extension) return f;
    throw UsageError(path.string() + ": scene of extension " + in_quotes(extension) +
                     "; accepted: .gltf .glb .obj .ply .stl .off");
}

}  // namespace

bool holds_polygons(const std::filesystem::path& path) {
    return format_of(path).polygons;
}

void save_scene(const Scene& scene, const std::filesystem::path& path, Monitor& monitor) {
    const Format& format = format_of(path);
    if (scene.polygons.empty())
        throw InputError(scene.path, "no polygon to write; accepted: one or more");
    StagedFiles files(path);
    const SceneWriter writer{scene, files, format.name, monitor};
    if (!format.polygons) writer.require_triangles();
    format.write(writer);
    files.put_in_place();
}

}  // namespace transillum
