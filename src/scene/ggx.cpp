#include "scene/ggx.h"

#include "scene/albedo_table.h"

#include <transillum/scene/brdf.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

template <class T>
T fifth_power(T x) {
    const T x2 = x * x;
    return x2 * x2 * x;
}

/// cos theta (1 + Lambda), Lambda of Smith's shadowing, times two less the cosine.
template <class T>
T smith_root(T alpha, T cosine) {
    return std::sqrt(alpha * alpha + (T(1) - alpha * alpha) * cosine * cosine);
}

/// A visible normal: a point of the disk that the hemisphere of normals, stretched to roughness 1,
/// shows towards `out`.
template <class T>
glm::vec<3, T> sample_visible_normal(T alpha, const glm::vec<3, T>& out, T u, T v) {
    using Vector = glm::vec<3, T>;
    const Vector view = glm::normalize(Vector(alpha * out.x, alpha * out.y, out.z));
    const T across = std::sqrt(view.x * view.x + view.y * view.y);
    const Vector side =
        across > T(0) ? Vector(-view.y / across, view.x / across, 0) : Vector(1, 0, 0);
    const Vector up = glm::cross(view, side);
    const T radius = std::sqrt(u);
    const T phi = T(2) * std::numbers::pi_v<T> * v;
    const T s = radius * std::cos(phi);
    const T half_visible = T(0.5) * (T(1) + view.z);
    const T t = (T(1) - half_visible) * std::sqrt(std::max(T(0), T(1) - s * s)) +
                half_visible * radius * std::sin(phi);
    const Vector n = s * side + t * up + std::sqrt(std::max(T(0), T(1) - s * s - t * t)) * view;
    return glm::normalize(Vector(alpha * n.x, alpha * n.y, std::max(T(1e-12), n.z)));
}

/// Visible normals carry D and the shadowing towards `out`; what is left to average is F times
/// G / G1 = cos' (cos + root) / (cos' root + cos root').
/// Points are dense near the disk's rim, where the tail of D lies.
glm::dvec2 integrated_shares(double alpha, double cosine) {
    constexpr int radii = 48, angles = 12;
    const glm::dvec3 out(std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), 0.0, cosine);
    const double root = smith_root(alpha, cosine);
    double normal = 0.0, grazing = 0.0, total = 0.0;
    for (int i = 0; i < radii; ++i) {
        const double inwards = 1.0 - (i + 0.5) / radii;
        const double u = 1.0 - std::pow(inwards, 4);
        const double weight = std::pow(inwards, 3);
        total += weight * angles;
        for (int j = 0; j < angles; ++j) {
            // Half the disk; the other half mirrors it.
            const double v = 0.25 + 0.5 * (j + 0.5) / angles;
            const glm::dvec3 n = sample_visible_normal(alpha, out, u, v);
            const double facing = glm::dot(out, n);
            const double in = 2.0 * facing * n.z - out.z;
            if (!(in > 0.0)) continue;
            const double share =
                weight * in * (cosine + root) / (in * root + cosine * smith_root(alpha, in));
            normal += share;
            grazing += share * fifth_power(1.0 - facing);
        }
    }
    return {normal / total, grazing / total};
}

constexpr double least_cosine = 1e-6;

/// Over log(1 + cos theta / alpha) and sqrt(alpha): finest where lobes are sharp and light grazes,
/// which it does below cos theta = alpha. Holds the share with F = 1, and by how much the other
/// exceeds it times (1 - cos theta)^5, which would bend more between the nodes.
class GgxTable {
public:
    GgxTable()
        : angles_([](double x, double y) {
              const double alpha = alpha_at(y);
              const double cosine = std::max(least_cosine, cosine_at(x, alpha));
              const glm::dvec2 s = integrated_shares(alpha, cosine);
              return glm::vec2(s.x, s.y - s.x * fifth_power(1.0 - cosine));
          }),
          means_([this](double, double y) { return mean(alpha_at(y)); }) {}

    [[nodiscard]] glm::vec2 at(float alpha, float cosine) const {
        const glm::vec2 s = angles_.at(column_of(cosine, alpha), row_of(alpha));
        const float grazing = s.y + s.x * fifth_power(1.0f - cosine);
        return {s.x, std::clamp(grazing, 0.0f, s.x)};
    }
    [[nodiscard]] glm::vec2 mean_at(float alpha) const { return means_.at(0.0f, row_of(alpha)); }

private:
    static double least_root() { return std::sqrt(static_cast<double>(least_alpha)); }
    static double alpha_at(double y) {
        const double root = least_root() + y * (1.0 - least_root());
        return root * root;
    }
    static float row_of(float alpha) {
        return static_cast<float>((std::sqrt(alpha) - least_root()) / (1.0 - least_root()));
    }
    static double cosine_at(double x, double alpha) {
        return alpha * std::expm1(x * std::log1p(1.0 / alpha));
    }
    static float column_of(float cosine, float alpha) {
        // log1p would be no better here, where 1e-7 of a node does not show, but takes its time.
        return std::log(1.0f + cosine / alpha) / std::log(1.0f + 1.0f / alpha);
    }
    [[nodiscard]] glm::vec2 mean(double alpha) const {
        constexpr int steps = 1024;
        glm::dvec2 sum(0.0);
        for (int i = 0; i < steps; ++i)
            sum += at(static_cast<float>(alpha), static_cast<float>(std::sqrt((i + 0.5) / steps)));
        return glm::vec2(sum / static_cast<double>(steps));
    }

    AlbedoTable<glm::vec2, 48, 48> angles_;
    AlbedoTable<glm::vec2, 2, 48> means_;
};

const GgxTable& table() {
    static const GgxTable values;
    return values;
}

}  // namespace

Spectrum ggx_value(const Spectrum& f0, float alpha, const glm::vec3& in, const glm::vec3& out) {
    const glm::vec3 sum = in + out;
    const float length = glm::length(sum);  // twice the cosine to the normal between
    const glm::vec3 n = sum / length;
    const float a2 = alpha * alpha;
    // 1 - cos^2 would cancel in sharp lobes.
    const float spread = n.x * n.x + n.y * n.y + a2 * n.z * n.z;
    const float d = a2 / (std::numbers::pi_v<float> * spread * spread);
    const float v = 0.5f / (in.z * smith_root(alpha, out.z) + out.z * smith_root(alpha, in.z));
    const float grazing = fifth_power(std::max(0.0f, 1.0f - 0.5f * length));
    return d * v * (f0 + (Spectrum(1.0f) - f0) * grazing);
}

glm::vec3 sample_ggx(float alpha, const glm::vec3& out, glm::vec2 u) {
    const glm::vec3 n = sample_visible_normal(alpha, out, u.x, u.y);
    return glm::normalize(2.0f * glm::dot(out, n) * n - out);
}

// D G1 (out . n) / cos theta, over 4 (out . n) for mirroring; G1 = 2 cos / (cos + root).
float ggx_density(float alpha, const glm::vec3& in, const glm::vec3& out) {
    const glm::vec3 n = glm::normalize(in + out);
    const float a2 = alpha * alpha;
    const float spread = n.x * n.x + n.y * n.y + a2 * n.z * n.z;
    const float d = a2 / (std::numbers::pi_v<float> * spread * spread);
    return 0.5f * d / (out.z + smith_root(alpha, out.z));
}

GgxShares ggx_shares(float alpha, float cos_theta) {
    const glm::vec2 v = table().at(alpha, cos_theta);
    return {v.x, v.y};
}

GgxShares ggx_mean_shares(float alpha) {
    const glm::vec2 v = table().mean_at(alpha);
    return {v.x, v.y};
}

}  // namespace transillum
