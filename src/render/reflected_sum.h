/// What a point reflects to the eye of light from given directions.
#pragma once

#include "render/surface_point.h"

#include <array>
#include <cstddef>
#include <span>

namespace transillum {

/// \param in local; \param irradiance of the point, cosine included
/// \param of_surface the rays that follow a sharp lobe meet it
[[nodiscard]] inline Spectrum reflected(const SurfacePoint& p, const glm::vec3& in,
                                        const Spectrum& irradiance, bool of_surface) {
    const bool diffuse_only = p.is_sharp && of_surface;
    return irradiance *
           (diffuse_only ? evaluate_diffuse(p.brdf, in, p.out) : evaluate(p.brdf, in, p.out));
}

/// Directions are gathered and evaluated some at a time: much of a BRDF they share.
class ReflectedSum {
public:
    /// Keeps a reference.
    explicit ReflectedSum(const SurfacePoint& p) : p_(p) {}

    /// As reflected. \pre in.z > 0
    void add(const glm::vec3& in, const Spectrum& irradiance, bool of_surface) {
        if (!p_.has_lobe()) {
            irradiance_of_matte_ += irradiance;
            return;
        }
        if (p_.is_sharp) {
            sum_ += reflected(p_, in, irradiance, of_surface);
            return;
        }
        in_[count_] = in;
        irradiance_[count_] = irradiance;
        if (++count_ == most) flush();
    }

    [[nodiscard]] Spectrum total() {
        flush();
        if (p_.has_lobe()) return sum_;
        return irradiance_of_matte_ * evaluate_diffuse(p_.brdf, {0.0f, 0.0f, 1.0f}, p_.out);
    }

private:
    void flush() {
        std::array<Spectrum, most> values;
        evaluate(p_.brdf, std::span(in_).first(count_), p_.out, std::span(values).first(count_));
        for (std::size_t i = 0; i < count_; ++i) sum_ += irradiance_[i] * values[i];
        count_ = 0;
    }

    static constexpr std::size_t most = 16;
    const SurfacePoint& p_;
    Spectrum sum_{0.0f};
    Spectrum irradiance_of_matte_{0.0f};  ///< reflected alike from everywhere
    std::array<glm::vec3, most> in_;
    std::array<Spectrum, most> irradiance_;
    std::size_t count_ = 0;
};

}  // namespace transillum
