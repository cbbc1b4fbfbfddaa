#include "scene/obj_materials.h"

#include "scene/soup.h"

#include <algorithm>

namespace transillum {

bool ObjMaterials::load_library(const std::string& name) {
    const std::filesystem::path file = obj_.parent_path() / name;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return false;
    for (MtlMaterial& m : read_mtl(file, monitor_)) {
        if (std::ranges::any_of(library_, [&](const MtlMaterial& l) {
                return l.material.name == m.material.name;
            })) {
            monitor_.warn(file.string() + ": material " + in_quotes(m.material.name) +
                          " comes twice; the first counts");
            continue;
        }
        library_.push_back(std::move(m));
    }
    return true;
}

void ObjMaterials::load(const TextReader& statement) {
    const auto warn_missing = [&](std::string_view name) {
        monitor_.warn(obj_.string() + ":" + std::to_string(statement.line()) +
                      ": material library " + in_quotes(name) +
                      " is not there; the default material is taken");
    };
    // One name with blanks, or several names.
    const std::string whole(statement.rest(1));
    if (whole.empty()) statement.fail("mtllib without a name; accepted: a file name");
    if (load_library(whole)) return;
    if (statement.words().size() == 2) return warn_missing(whole);
    for (std::size_t i = 1; i < statement.words().size(); ++i)
        if (!load_library(std::string(statement.words()[i]))) warn_missing(statement.words()[i]);
}

std::uint32_t ObjMaterials::current() {
    const auto next = static_cast<std::uint32_t>(names_.size());
    const auto [entry, is_new] = number_of_name_.try_emplace(selected_, next);
    if (is_new) names_.push_back(selected_);
    return entry->second;
}

std::uint32_t ObjMaterials::index_of(const std::string& name, Scene& scene) {
    const auto defined = std::ranges::find(scene.materials, name, &Material::name);
    if (!name.empty() && defined == scene.materials.end() && !library_.empty())
        monitor_.warn(scene.path + ": material " + in_quotes(name) +
                      " is not defined; the default material is taken");
    if (defined == scene.materials.end()) {
        scene.materials.push_back(named_material(name.empty() ? "default" : name));
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    }
    return static_cast<std::uint32_t>(defined - scene.materials.begin());
}

/// As the maps' options say, which are for v that runs upwards; in a scene it runs downwards.
void ObjMaterials::place_uvs(Scene& scene) const {
    if (scene.uvs.empty()) return;
    for (const Polygon& polygon : scene.polygons) {
        const MtlMap* map =
            polygon.material < library_.size() ? main_map(library_[polygon.material]) : nullptr;
        if (!map || (map->scale == glm::vec2(1.0f) && map->offset == glm::vec2(0.0f))) continue;
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
            glm::vec2& uv = scene.uvs[polygon.first_corner + c];
            uv = map->scale * glm::vec2(uv.x, 1.0f - uv.y) + map->offset;
            uv.y = 1.0f - uv.y;
        }
    }
}

void ObjMaterials::finish(Scene& scene) {
    for (const MtlMaterial& m : library_) scene.materials.push_back(m.material);
    std::vector<std::uint32_t> material_of_number;
    for (const std::string& name : names_) material_of_number.push_back(index_of(name, scene));
    for (Polygon& polygon : scene.polygons) polygon.material = material_of_number[polygon.material];
    for (const std::uint32_t used : material_of_number)
        if (used < library_.size()) textures_.apply(library_[used], scene.materials[used], scene);
    place_uvs(scene);
}

}  // namespace transillum
