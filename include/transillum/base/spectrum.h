/// Spectral quantities as channels; three of them, linear Rec.709, unless a scene says otherwise.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace transillum {

/// One value a channel: radiance [W sr^-1 m^-2], irradiance or radiosity [W m^-2], albedo [1].
using Spectrum = glm::vec3;
/// The same in double precision, for sums over many patches.
using SpectrumSum = glm::dvec3;

inline constexpr int channel_count = 3;

/// Rec.709 luminance weights.
template <class T>
[[nodiscard]] T luminance(const glm::vec<3, T>& s) {
    return T(0.2126) * s.x + T(0.7152) * s.y + T(0.0722) * s.z;
}

template <class T>
[[nodiscard]] T max_channel(const glm::vec<3, T>& s) {
    return glm::max(s.x, glm::max(s.y, s.z));
}

template <class T>
[[nodiscard]] T mean_channel(const glm::vec<3, T>& s) {
    return (s.x + s.y + s.z) / T(3);
}

template <class T>
[[nodiscard]] bool is_finite(const glm::vec<3, T>& s) {
    return std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z);
}

}  // namespace transillum
