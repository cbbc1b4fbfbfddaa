#include <transillum/scene/load_scene.h>

#include "scene/read_gltf.h"
#include "scene/read_obj.h"
#include "scene/read_off.h"
#include "scene/read_ply.h"
#include "scene/read_stl.h"
#include "scene/text_reader.h"

#include <transillum/base/error.h>

#include <algorithm>
#include <cctype>

namespace transillum {

namespace {

Scene read_by_extension(const std::filesystem::path& path, Monitor& monitor) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    if (extension == ".gltf" || extension == ".glb") return read_gltf(path, monitor);
    if (extension == ".obj") return read_obj(path, monitor);
    if (extension == ".ply") return read_ply(path, monitor);
    if (extension == ".stl") return read_stl(path);
    if (extension == ".off") return read_off(path);
    throw InputError(path.string(), "extension " + in_quotes(extension) +
                                        "; accepted: .gltf .glb .obj .ply .stl .off");
}

void choose_sides(Scene& scene, Sides sides) {
    if (sides == Sides::file) return;
    for (Material& m : scene.materials) m.back_reflects = m.back_emits = sides == Sides::two;
}

void drop_transparent(Scene& scene) {
    std::erase_if(scene.polygons,
                  [&](const Polygon& p) { return scene.materials[p.material].opacity < 1.0f; });
}

void treat_transparent(Scene& scene, bool drop, Monitor& monitor) {
    std::vector<std::size_t> count(scene.materials.size(), 0);
    for (const Polygon& p : scene.polygons) ++count[p.material];
    for (std::size_t i = 0; i < count.size(); ++i) {
        const Material& m = scene.materials[i];
        if (count[i] == 0 || m.opacity >= 1.0f) continue;
        const std::string what = scene.path + ": material " + in_quotes(m.name) +
                                 " is transparent (opacity " + std::to_string(m.opacity) +
                                 "): its " + std::to_string(count[i]) + " polygons are ";
        if (drop) {
            monitor.note(what + "left out");
        } else {
            monitor.warn(what + "treated as opaque");
        }
    }
    if (drop) drop_transparent(scene);
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const LoadOptions& options, Monitor& monitor) {
    Scene scene = read_by_extension(path, monitor);
    if (scene.polygons.empty())
        throw InputError(scene.path, "no polygon found; accepted: one or more");
    choose_sides(scene, options.sides);
    treat_transparent(scene, options.drop_transparent, monitor);
    if (scene.polygons.empty())
        throw InputError(
            scene.path,
            "every polygon is transparent and left out; accepted: one or more that stay");
    return scene;
}

}  // namespace transillum
