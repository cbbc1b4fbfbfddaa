/// The maps of Wavefront materials.
#pragma once

#include "scene/read_mtl.h"

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace transillum {

class ObjTextures {
public:
    ObjTextures(std::filesystem::path folder, Monitor& monitor)
        : folder_(std::move(folder)), monitor_(monitor) {}

    /// Sets the textures of a material and their means. A missing map is warned of, and what the
    /// library says without it is taken. \throws InputError naming the image
    void apply(const MtlMaterial& library, Material& material, Scene& scene);

private:
    void apply_map(const MtlMap& map, bool emits, const MtlMap& main, const std::string& where,
                   Spectrum& value, std::int32_t& texture, Scene& scene);

    std::filesystem::path folder_;
    Monitor& monitor_;
    /// Textures by all that they depend on.
    std::map<std::string, std::pair<Spectrum, std::int32_t>> made_;
};

/// The map whose texture coordinates all maps of a material take: the diffuse one, else the
/// specular, else that of emission. Null without maps.
[[nodiscard]] const MtlMap* main_map(const MtlMaterial& material);

}  // namespace transillum
