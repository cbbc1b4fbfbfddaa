#include "scene/channel_limit.h"

#include <transillum/scene/brdf.h>

#include <algorithm>
#include <cmath>

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
float reflected_share(const GgxShares& shares, float diffuse, float specular) {
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

}  // namespace

ChannelLimit::ChannelLimit(const Material& material)
    : couples_(material.lobe == Lobe::ggx && max_channel(material.specular) > 0.0f) {
    if (!couples_) return;
    const float alpha = brdf_of(material).alpha;
    shares_ = {ggx_shares(alpha, 1.0f), ggx_mean_shares(alpha)};
}

float ChannelLimit::reflected(float diffuse, float specular) const {
    if (!couples_) return diffuse + specular;
    return std::max(reflected_share(shares_[0], diffuse, specular),
                    reflected_share(shares_[1], diffuse, specular));
}

void ChannelLimit::limit(float& diffuse, float& specular, float most) const {
    if (reflected(diffuse, specular) <= most) return;
    if (!couples_) return limit_sum(diffuse, specular, most);
    float scale = std::min(scale_to(shares_[0], diffuse, specular, most),
                           scale_to(shares_[1], diffuse, specular, most));
    // Rounding may have left an ulp too much.
    while (scale > 0.0f && reflected(scale * diffuse, scale * specular) > most)
        scale = std::nextafter(scale * (1.0f - 0x1p-22f), 0.0f);
    diffuse *= scale;
    specular *= scale;
}

}  // namespace transillum
