#include "scene/obj_textures.h"

#include "scene/read_texture.h"
#include "scene/scene_textures.h"
#include "scene/text_reader.h"

#include <sstream>

namespace transillum {

namespace {

std::string shown(const Spectrum& s) {
    std::ostringstream text;
    text << s.r << ' ' << s.g << ' ' << s.b;
    return text.str();
}

}  // namespace

const MtlMap* main_map(const MtlMaterial& material) {
    for (const MtlMap* map :
         {&material.diffuse_map, &material.specular_map, &material.emission_map})
        if (!map->file.empty()) return map;
    return nullptr;
}

void ObjTextures::apply_map(const MtlMap& map, bool emits, const MtlMap& main,
                            const std::string& where, Spectrum& value, std::int32_t& texture,
                            Scene& scene) {
    const std::filesystem::path file = folder_ / map.file;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
        monitor_.warn(where + ": its texture " + in_quotes(map.file) + " is not there; " +
                      shown(map.without) + " is taken");
        value = map.without;
        return;
    }
    const bool own_frame = map.scale != main.scale || map.offset != main.offset;
    if (own_frame)
        monitor_.warn(where + ": its texture " + in_quotes(map.file) +
                      " is placed apart from its first; its mean is taken");
    std::ostringstream key;
    key << std::hexfloat << file << emits << map.clamp << own_frame << value.r << ' ' << value.g
        << ' ' << value.b;
    if (const auto made = made_.find(key.str()); made != made_.end()) {
        std::tie(value, texture) = made->second;
        return;
    }
    Texture image =
        read_texture(file.string(), emits ? ImageUse::emission : ImageUse::albedo, monitor_)
            .texture;
    for (Spectrum& texel : image.texels) texel *= value;
    if (map.clamp) image.wrap_u = image.wrap_v = Texture::Wrap::clamp;
    const Textured result =
        own_frame ? Textured{image.mean()} : add_texture(scene, std::move(image));
    made_.emplace(key.str(), std::pair(result.mean, result.texture));
    value = result.mean;
    texture = result.texture;
}

void ObjTextures::apply(const MtlMaterial& library, Material& material, Scene& scene) {
    const MtlMap* main = main_map(library);
    if (!main) return;
    const std::string where = scene.path + ": material " + in_quotes(material.name);
    const auto apply_to = [&](const MtlMap& map, bool emits, Spectrum& value,
                              std::int32_t& texture) {
        if (!map.file.empty() && max_channel(value) > 0.0f)
            apply_map(map, emits, *main, where, value, texture, scene);
    };
    apply_to(library.diffuse_map, false, material.diffuse, material.textures.diffuse);
    apply_to(library.specular_map, false, material.specular, material.textures.specular);
    apply_to(library.emission_map, true, material.emission, material.textures.emission);
}

}  // namespace transillum
