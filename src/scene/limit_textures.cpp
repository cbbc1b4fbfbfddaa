#include "scene/limit_textures.h"

#include "scene/channel_limit.h"
#include "scene/scene_textures.h"

#include <algorithm>

namespace transillum {

namespace {

const Texture* texture_at(const Scene& scene, std::int32_t index) {
    return index < 0 ? nullptr : scene.textures[static_cast<std::size_t>(index)].get();
}

Spectrum largest(const Texture* texture, const Spectrum& uniform) {
    if (!texture) return uniform;
    Spectrum most(0.0f);
    for (const Spectrum& texel : texture->texels) most = glm::max(most, texel);
    return most;
}

bool share_a_grid(const Texture& a, const Texture& b) {
    return a.width == b.width && a.height == b.height && a.wrap_u == b.wrap_u &&
           a.wrap_v == b.wrap_v;
}

/// Values of a reflectance on the texels of a grid.
std::vector<Spectrum> on_grid(const Texture* texture, const Spectrum& uniform,
                              const Texture& grid) {
    if (texture && share_a_grid(*texture, grid)) return texture->texels;
    const auto w = static_cast<std::size_t>(grid.width);
    std::vector<Spectrum> values(w * static_cast<std::size_t>(grid.height), uniform);
    for (std::size_t i = 0; i < values.size() && texture; ++i)
        values[i] =
            texture->at({(static_cast<float>(i % w) + 0.5f) / static_cast<float>(w),
                         (static_cast<float>(i / w) + 0.5f) / static_cast<float>(grid.height)});
    return values;
}

}  // namespace

Spectrum largest_albedo(const Scene& scene, const Material& material) {
    const Texture* diffuse = texture_at(scene, material.textures.diffuse);
    const Texture* specular = texture_at(scene, material.textures.specular);
    const ChannelLimit limit(material);
    const auto reflected = [&](const Spectrum& d, const Spectrum& s) {
        Spectrum sum;
        for (int c = 0; c < channel_count; ++c) sum[c] = limit.reflected(d[c], s[c]);
        return sum;
    };
    if (!diffuse || !specular || !share_a_grid(*diffuse, *specular))
        return reflected(largest(diffuse, material.diffuse), largest(specular, material.specular));
    Spectrum most(0.0f);
    for (std::size_t i = 0; i < diffuse->texels.size(); ++i)
        most = glm::max(most, reflected(diffuse->texels[i], specular->texels[i]));
    return most;
}

void limit_textures(Scene& scene, Material& material, float max_albedo) {
    const Texture* diffuse = texture_at(scene, material.textures.diffuse);
    const Texture* specular = texture_at(scene, material.textures.specular);
    // Both on one grid, so that between texels too the sum is a mean of limited ones.
    const Texture& named = diffuse ? *diffuse : *specular;
    Texture limited_diffuse{.name = named.name, .wrap_u = named.wrap_u, .wrap_v = named.wrap_v};
    for (const Texture* t : {diffuse, specular}) {
        if (!t) continue;
        limited_diffuse.width = std::max(limited_diffuse.width, t->width);
        limited_diffuse.height = std::max(limited_diffuse.height, t->height);
    }
    Texture limited_specular = limited_diffuse;
    limited_diffuse.texels = on_grid(diffuse, material.diffuse, limited_diffuse);
    limited_specular.texels = on_grid(specular, material.specular, limited_specular);
    const ChannelLimit limit(material);
    for (std::size_t i = 0; i < limited_diffuse.texels.size(); ++i) {
        Spectrum& d = limited_diffuse.texels[i];
        Spectrum& s = limited_specular.texels[i];
        for (int c = 0; c < channel_count; ++c) limit.limit(d[c], s[c], max_albedo);
    }
    const Textured d = add_texture(scene, std::move(limited_diffuse));
    const Textured s = add_texture(scene, std::move(limited_specular));
    material.diffuse = d.mean;
    material.textures.diffuse = d.texture;
    material.specular = s.mean;
    material.textures.specular = s.texture;
}

}  // namespace transillum
