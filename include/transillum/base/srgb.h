/// The transfer function of sRGB (IEC 61966-2-1), a channel at a time.
#pragma once

#include <algorithm>
#include <cmath>

namespace transillum {

/// Values outside [0, 1] are clamped.
[[nodiscard]] inline float srgb_from_linear(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

/// \pre encoded >= 0
[[nodiscard]] inline float linear_from_srgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace transillum
