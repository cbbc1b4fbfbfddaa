#include <transillum/scene/limit_albedo.h>

#include "scene/channel_limit.h"
#include "scene/limit_textures.h"
#include "scene/scene_textures.h"

#include <transillum/base/error.h>

#include <iomanip>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace transillum {

namespace {

/// Materials that share textures go on to share the limited ones.
class LimitedTextures {
public:
    LimitedTextures(Scene& scene, float max_albedo) : scene_(scene), max_albedo_(max_albedo) {}

    void apply(Material& material) {
        for (const auto& [before, after] : done_) {
            if (!reflects_alike(before, material)) continue;
            material.diffuse = after.diffuse;
            material.specular = after.specular;
            material.textures.diffuse = after.textures.diffuse;
            material.textures.specular = after.textures.specular;
            return;
        }
        done_.emplace_back(material, material);
        limit_textures(scene_, material, max_albedo_);
        done_.back().second = material;
    }

private:
    static bool reflects_alike(const Material& a, const Material& b) {
        return a.lobe == b.lobe && a.roughness == b.roughness && a.diffuse == b.diffuse &&
               a.specular == b.specular && a.textures.diffuse == b.textures.diffuse &&
               a.textures.specular == b.textures.specular;
    }
    Scene& scene_;
    float max_albedo_;
    std::vector<std::pair<Material, Material>> done_;  ///< before and after
};

Spectrum reflected(const ChannelLimit& limit, const Material& material) {
    Spectrum sum;
    for (int c = 0; c < channel_count; ++c)
        sum[c] = limit.reflected(material.diffuse[c], material.specular[c]);
    return sum;
}

}  // namespace

void limit_albedo(Scene& scene, float max_albedo, Monitor& monitor) {
    if (!(max_albedo > 0.0f && max_albedo <= 1.0f))
        throw UsageError("max_albedo is " + std::to_string(max_albedo) +
                         "; accepted: above 0, at most 1");
    LimitedTextures limited(scene, max_albedo);
    for (Material& material : scene.materials) {
        const ChannelLimit limit(material);
        const Spectrum mean_before = reflected(limit, material);
        const bool varies = material.textures.diffuse >= 0 || material.textures.specular >= 0;
        const Spectrum before = varies ? largest_albedo(scene, material) : mean_before;
        if (max_channel(before) <= max_albedo) continue;
        if (varies) {
            limited.apply(material);
        } else {
            for (int c = 0; c < channel_count; ++c)
                limit.limit(material.diffuse[c], material.specular[c], max_albedo);
        }
        const float removed =
            1.0f - mean_channel(reflected(limit, material)) / mean_channel(mean_before);
        std::ostringstream message;
        message << "material '" << material.name << "' reflects " << (varies ? "up to " : "")
                << before.x << ' ' << before.y << ' ' << before.z << ", above the limit of "
                << max_albedo << ": " << std::setprecision(2) << 100.0f * removed
                << " % of the light it reflects is removed";
        monitor.warn(message.str());
    }
    drop_unused_textures(scene);
}

}  // namespace transillum
