#include "scene/scene_textures.h"

#include "scene/text_reader.h"

#include <transillum/base/error.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace transillum {

namespace {

/// Of all textures: materials that differ in a factor have a texture each of one image.
constexpr std::size_t most_texels = std::size_t{1} << 28;

template <class Visit>
void for_textures(MaterialTextures& t, Visit visit) {
    for (std::int32_t* index : {&t.diffuse, &t.specular, &t.roughness, &t.emission})
        if (*index >= 0) visit(*index);
}

bool has_textures(const Material& m) {
    const MaterialTextures& t = m.textures;
    return std::max({t.diffuse, t.specular, t.roughness, t.emission}) >= 0;
}

void check_uvs(const Scene& scene) {
    for (std::size_t p = 0; p < scene.polygons.size() && !scene.uvs.empty(); ++p) {
        const Polygon& polygon = scene.polygons[p];
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
            const glm::vec2& uv = scene.uvs[polygon.first_corner + c];
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
                throw InputError(scene.path, "face " + std::to_string(p) +
                                                 " has a texture coordinate that is not finite; "
                                                 "accepted: finite numbers");
        }
    }
}

}  // namespace

Textured add_texture(Scene& scene, Texture texture) {
    if (std::ranges::all_of(texture.texels,
                            [&](const Spectrum& t) { return t == texture.texels[0]; }))
        return {texture.texels[0]};
    std::size_t texels = texture.texels.size();
    for (const auto& other : scene.textures) texels += other->texels.size();
    if (texels > most_texels)
        throw InputError(texture.name, "brings the scene's textures to more than " +
                                           std::to_string(most_texels) +
                                           " texels; accepted: fewer");
    texture.build_levels();
    const Spectrum mean = texture.mean();
    scene.textures.push_back(std::make_shared<const Texture>(std::move(texture)));
    return {mean, static_cast<std::int32_t>(scene.textures.size() - 1)};
}

void drop_unused_textures(Scene& scene) {
    std::vector<std::int32_t> renumbered(scene.textures.size(), -1);
    std::vector<std::shared_ptr<const Texture>> kept;
    for (Material& m : scene.materials) {
        for_textures(m.textures, [&](std::int32_t& index) {
            const auto old = static_cast<std::size_t>(index);
            if (renumbered[old] < 0) {
                renumbered[old] = static_cast<std::int32_t>(kept.size());
                kept.push_back(scene.textures[old]);
            }
            index = renumbered[old];
        });
    }
    scene.textures = std::move(kept);
}

void finish_textures(Scene& scene, const std::vector<std::uint8_t>& has_uvs, Monitor& monitor) {
    check_uvs(scene);
    std::vector<bool> is_placed(scene.materials.size());
    for (std::size_t p = 0; p < scene.polygons.size(); ++p)
        if (has_uvs[p]) is_placed[scene.polygons[p].material] = true;
    std::map<std::uint32_t, std::uint32_t> uniform;
    for (std::size_t p = 0; p < scene.polygons.size(); ++p) {
        std::uint32_t& material = scene.polygons[p].material;
        if (has_uvs[p] || !has_textures(scene.materials[material])) continue;
        const auto [found, is_new] =
            uniform.try_emplace(material, static_cast<std::uint32_t>(scene.materials.size()));
        if (is_new) {
            monitor.warn(scene.path + ": material " + in_quotes(scene.materials[material].name) +
                         ": faces without texture coordinates get its textures' means");
            scene.materials.push_back(scene.materials[material]);
            scene.materials.back().textures = {};
        }
        material = found->second;
    }
    for (const auto& [textured, copy] : uniform)
        if (!is_placed[textured]) scene.materials[textured].textures = {};
    drop_unused_textures(scene);
}

}  // namespace transillum
