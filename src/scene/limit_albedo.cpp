#include <transillum/scene/limit_albedo.h>

#include "scene/ggx.h"

#include <transillum/base/error.h>
#include <transillum/scene/brdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace transillum {

namespace {

void limit_sum(float& a, float& b, float limit) {
    const float scale = limit / (a + b);
    a *= scale;
    b *= scale;
    // Rounding may have left the sum an ulp above the limit.
    while (a + b > limit) {
        float& larger = a > b ? a : b;
        larger = std::nextafter(larger, 0.0f);
    }
}

/// A GGX lobe that reflects x leaves its coupled diffuse part at most diffuse * (1 - x) (brdf.h),
/// which makes 1 - (1 - x) (1 - diffuse) in all.
float reflected(const GgxShares& shares, float diffuse, float specular) {
    return 1.0f - (1.0f - shares.albedo(specular)) * (1.0f - diffuse);
}

/// What both parts are multiplied by so that they reflect the limit: with 1 - x = (1 - grazing)
/// (1 - q specular), the smaller root of (1 - k q specular) (1 - k diffuse) = (1 - limit) /
/// (1 - grazing).
float scale_to(const GgxShares& shares, float diffuse, float specular, float limit) {
    const float left = (1.0f - limit) / (1.0f - shares.grazing);
    if (left >= 1.0f) return 0.0f;
    const float lobe = specular * (shares.normal - shares.grazing) / (1.0f - shares.grazing);
    const float sum = lobe + diffuse;
    const float root = std::sqrt(std::max(0.0f, sum * sum - 4.0f * lobe * diffuse * (1.0f - left)));
    return std::min(1.0f, 2.0f * (1.0f - left) / (sum + root));
}

/// What one channel of a material's kind reflects, and how it is limited.
class ChannelLimit {
public:
    explicit ChannelLimit(const Material& material)
        : couples_(material.lobe == Lobe::ggx && max_channel(material.specular) > 0.0f) {
        if (!couples_) return;
        const float alpha = brdf_of(material).alpha;
        shares_ = {ggx_shares(alpha, 1.0f), ggx_mean_shares(alpha)};
    }
    [[nodiscard]] float operator()(float diffuse, float specular) const {
        if (!couples_) return diffuse + specular;
        return std::max(reflected(shares_[0], diffuse, specular),
                        reflected(shares_[1], diffuse, specular));
    }
    void limit(float& diffuse, float& specular, float most) const {
        if (!couples_) return limit_sum(diffuse, specular, most);
        float scale = std::min(scale_to(shares_[0], diffuse, specular, most),
                               scale_to(shares_[1], diffuse, specular, most));
        // Rounding may have left an ulp too much.
        while (scale > 0.0f && (*this)(scale * diffuse, scale * specular) > most)
            scale = std::nextafter(scale * (1.0f - 0x1p-22f), 0.0f);
        diffuse *= scale;
        specular *= scale;
    }

private:
    bool couples_;
    std::array<GgxShares, 2> shares_{};  ///< along the normal; of uniform light
};

}  // namespace

void limit_albedo(Scene& scene, float max_albedo, Monitor& monitor) {
    if (!(max_albedo > 0.0f && max_albedo <= 1.0f))
        throw UsageError("max_albedo is " + std::to_string(max_albedo) +
                         "; accepted: above 0, at most 1");
    for (Material& material : scene.materials) {
        const ChannelLimit limited(material);
        Spectrum before, after;
        for (int c = 0; c < channel_count; ++c) {
            float &diffuse = material.diffuse[c], &specular = material.specular[c];
            before[c] = limited(diffuse, specular);
            if (before[c] > max_albedo) limited.limit(diffuse, specular, max_albedo);
            after[c] = limited(diffuse, specular);
        }
        if (max_channel(before) <= max_albedo) continue;
        const float removed = 1.0f - mean_channel(after) / mean_channel(before);
        std::ostringstream message;
        message << "material '" << material.name << "' reflects " << before.x << ' ' << before.y
                << ' ' << before.z << ", above the limit of " << max_albedo << ": "
                << std::setprecision(2) << 100.0f * removed
                << " % of the light it reflects is removed";
        monitor.warn(message.str());
    }
}

}  // namespace transillum
