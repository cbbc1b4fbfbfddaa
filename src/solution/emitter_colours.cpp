#include "solution/emitter_colours.h"

#include <utility>

namespace transillum {

namespace {

/// Others may share the texture: the product is one more.
void scale_material(Colours& colours, Material& material, const Spectrum& factor) {
    material.emission *= factor;
    std::int32_t& number = material.textures.emission;
    if (number < 0) return;
    Texture texture = *colours.textures[static_cast<std::size_t>(number)];
    for (Spectrum& texel : texture.texels) texel *= factor;
    texture.levels.clear();
    texture.build_levels();
    number = static_cast<std::int32_t>(colours.textures.size());
    colours.textures.push_back(std::make_shared<const Texture>(std::move(texture)));
}

}  // namespace

Colours only(Colours colours, const Emitter& emitter) {
    using Kind = Emitter::Kind;
    for (std::uint32_t i = 0; i < colours.materials.size(); ++i)
        if (emitter.kind != Kind::material || emitter.index != i)
            colours.materials[i].emission = Spectrum(0.0f);
    std::vector<PunctualLight>& lights = colours.lighting.lights;
    for (std::uint32_t i = 0; i < lights.size(); ++i)
        if (emitter.kind != Kind::light || emitter.index != i) lights[i].intensity = Spectrum(0.0f);
    if (emitter.kind != Kind::environment) colours.lighting.environment = {};
    return colours;
}

Colours scaled(Colours colours, const Emitter& emitter, const Spectrum& factor) {
    switch (emitter.kind) {
        case Emitter::Kind::material:
            scale_material(colours, colours.materials[emitter.index], factor);
            break;
        case Emitter::Kind::light:
            colours.lighting.lights[emitter.index].intensity *= factor;
            break;
        case Emitter::Kind::environment:
            colours.lighting.environment.radiance_scale *= factor;
            break;
    }
    return colours;
}

}  // namespace transillum
