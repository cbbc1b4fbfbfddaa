#include <transillum/scene/colours.h>

#include <map>
#include <utility>

namespace transillum {

namespace {

class Recolouring {
public:
    Recolouring(const Colours& rgb, const glm::dmat3& group_from_rgb)
        : rgb_(rgb), group_from_rgb_(group_from_rgb) {}

    Colours run() {
        result_.materials = rgb_.materials;
        for (Material& m : result_.materials) {
            const bool has_lobe = m.lobe != Lobe::none && max_channel(m.specular) > 0.0f;
            m.diffuse = recoloured(m.diffuse);
            m.specular = recoloured(m.specular);
            if (has_lobe) m.specular = glm::max(m.specular, Spectrum(least_specular));
            m.emission = recoloured(m.emission);
            m.textures.diffuse = texture(m.textures.diffuse, true);
            m.textures.specular = texture(m.textures.specular, true);
            m.textures.roughness = texture(m.textures.roughness, false);
            m.textures.emission = texture(m.textures.emission, true);
        }
        result_.lighting = rgb_.lighting;
        for (PunctualLight& light : result_.lighting.lights)
            light.intensity = recoloured(light.intensity);
        recolour(result_.lighting.environment);
        return std::move(result_);
    }

private:
    [[nodiscard]] Spectrum recoloured(const Spectrum& colour) const {
        return Spectrum(group_from_rgb_ * SpectrumSum(colour));
    }

    [[nodiscard]] std::shared_ptr<const Texture> recoloured(const Texture& texture,
                                                            const Spectrum& factor) const {
        Texture result = texture;
        for (Spectrum& texel : result.texels) texel = recoloured(factor * texel);
        if (!result.levels.empty()) result.build_levels();
        return std::make_shared<const Texture>(std::move(result));
    }

    void recolour(Environment& environment) const {
        if (!environment.image) {
            environment.radiance_scale = recoloured(environment.radiance_scale);
            return;
        }
        environment.image = recoloured(*environment.image, environment.radiance_scale);
        environment.radiance_scale = Spectrum(1.0f);
    }

    /// Its index in the result.
    std::int32_t texture(std::int32_t index, bool is_colour) {
        if (index < 0) return index;
        const auto next = static_cast<std::int32_t>(result_.textures.size());
        const auto [at, is_new] = known_.try_emplace({index, is_colour}, next);
        const auto& before = rgb_.textures[static_cast<std::size_t>(index)];
        if (is_new)
            result_.textures.push_back(is_colour ? recoloured(*before, Spectrum(1.0f)) : before);
        return at->second;
    }

    const Colours& rgb_;
    const glm::dmat3& group_from_rgb_;
    Colours result_;
    std::map<std::pair<std::int32_t, bool>, std::int32_t> known_;
};

}  // namespace

Colours colours_in_group(const Colours& rgb, const Bands& bands, int group) {
    return Recolouring(rgb, bands.group_from_rgb(group)).run();
}

}  // namespace transillum
