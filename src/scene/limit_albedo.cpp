#include <transillum/scene/limit_albedo.h>

#include <transillum/base/error.h>

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

}  // namespace

void limit_albedo(Scene& scene, float max_albedo, Monitor& monitor) {
    if (!(max_albedo > 0.0f && max_albedo <= 1.0f))
        throw UsageError("max_albedo is " + std::to_string(max_albedo) +
                         "; accepted: above 0, at most 1");
    for (Material& material : scene.materials) {
        const Spectrum before = material.albedo();
        if (max_channel(before) <= max_albedo) continue;
        for (int c = 0; c < channel_count; ++c)
            if (before[c] > max_albedo)
                limit_sum(material.diffuse[c], material.specular[c], max_albedo);
        const float removed = 1.0f - mean_channel(material.albedo()) / mean_channel(before);
        std::ostringstream message;
        message << "material '" << material.name << "' reflects " << before.x << ' ' << before.y
                << ' ' << before.z << ", above the limit of " << max_albedo << ": "
                << std::setprecision(2) << 100.0f * removed
                << " % of the light it reflects is removed";
        monitor.warn(message.str());
    }
}

}  // namespace transillum
