#include "scene/max_phong.h"

#include "scene/albedo_table.h"

#include <transillum/base/sampling.h>
#include <transillum/scene/brdf.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

glm::vec3 mirrored(const glm::vec3& out) {
    return {-out.x, -out.y, out.z};
}

/// Mean over the azimuth phi of max(0, min(1, (a + b cos phi) / m)), b >= 0, m > 0.
double mean_over_azimuth(double a, double b, double m) {
    if (!(b > 0.0)) return std::clamp(a / m, 0.0, 1.0);
    const double full = std::acos(std::clamp((m - a) / b, -1.0, 1.0));
    const double none = std::acos(std::clamp(-a / b, -1.0, 1.0));
    const double linear = a * (none - full) + b * (std::sin(none) - std::sin(full));
    return (full + linear / m) / std::numbers::pi;
}

/// f cos theta' is ks cos^n(alpha) min(1, cos theta' / cos theta): its mean under a density of
/// cos^n(alpha) about the mirror direction.
double integrated_albedo(double n, double cos_theta) {
    constexpr int steps = 256;
    const double sin_theta = std::sqrt(std::max(0.0, 1.0 - cos_theta * cos_theta));
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = std::pow((i + 0.5) / steps, 1.0 / (n + 1.0));
        const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
        sum += mean_over_azimuth(cosine * cos_theta, sine * sin_theta, cos_theta);
    }
    return (n + 2.0) / (n + 1.0) * sum / steps;
}

/// Widths 1 / sqrt(n + 1) of lobes in the table; sharper ones differ at grazing angles only.
constexpr double least_width = 1e-3;
constexpr double most_width = std::numbers::sqrt2 / 2.0;
static_assert(least_shininess == 1.0f);
constexpr double least_cosine = 1e-6;

/// Over log(1 + cos theta / width) and sqrt(width): finest where lobes are sharp and light grazes,
/// which it does below cos theta = width.
class MaxPhongAlbedos {
public:
    MaxPhongAlbedos()
        : angles_([](double x, double y) {
              const double width = width_at(y);
              const double cosine = width * std::expm1(x * std::log1p(1.0 / width));
              return static_cast<float>(
                  integrated_albedo(1.0 / (width * width) - 1.0, std::max(least_cosine, cosine)));
          }),
          means_([this](double, double y) { return mean(width_at(y)); }) {}

    [[nodiscard]] float at(float width, float cosine) const {
        // log1p would be no better here, where 1e-7 of a node does not show, but takes its time.
        return angles_.at(std::log(1.0f + cosine / width) / std::log(1.0f + 1.0f / width),
                          row_of(width));
    }
    [[nodiscard]] float mean_at(float width) const { return means_.at(0.0f, row_of(width)); }

private:
    static double width_at(double y) {
        const double root =
            std::sqrt(least_width) + y * (std::sqrt(most_width) - std::sqrt(least_width));
        return root * root;
    }
    static float row_of(float width) {
        return static_cast<float>((std::sqrt(width) - std::sqrt(least_width)) /
                                  (std::sqrt(most_width) - std::sqrt(least_width)));
    }
    [[nodiscard]] float mean(double width) const {
        constexpr int steps = 1024;
        double sum = 0.0;
        for (int i = 0; i < steps; ++i)
            sum += at(static_cast<float>(width), static_cast<float>(std::sqrt((i + 0.5) / steps)));
        return static_cast<float>(sum / steps);
    }

    AlbedoTable<float, 48, 32> angles_;
    AlbedoTable<float, 2, 32> means_;
};

const MaxPhongAlbedos& albedos() {
    static const MaxPhongAlbedos table;
    return table;
}

float width_of(float shininess) {
    return 1.0f / std::sqrt(shininess + 1.0f);
}

}  // namespace

float max_phong_value(float shininess, const glm::vec3& in, const glm::vec3& out) {
    return MaxPhongTowards(shininess, out).value(in);
}

glm::vec3 sample_max_phong(float shininess, const glm::vec3& out, glm::vec2 u) {
    const float exponent = 1.0f / (shininess + 1.0f);
    const float below_one = -std::expm1(exponent * std::log(1.0f - u.x));
    const float sine = std::sqrt(std::max(0.0f, below_one * (2.0f - below_one)));
    const float phi = 2.0f * pi * u.y;
    const glm::mat3 frame(frame_about(glm::dvec3(mirrored(out))));
    glm::vec3 in = frame * glm::vec3(sine * std::cos(phi), sine * std::sin(phi), 1.0f - below_one);
    in.z = std::abs(in.z);
    return glm::normalize(in);
}

float max_phong_density(float shininess, const glm::vec3& in, const glm::vec3& out) {
    const glm::vec3 centre = mirrored(out);
    const glm::vec3 below(in.x, in.y, -in.z);
    const CosinePower power(shininess);
    return (shininess + 1.0f) / (2.0f * pi) *
           (power.of_cosine(in, centre) + power.of_cosine(below, centre));
}

float max_phong_albedo(float shininess, float cos_theta) {
    return albedos().at(width_of(shininess), cos_theta);
}

float max_phong_mean_albedo(float shininess) {
    return albedos().mean_at(width_of(shininess));
}

}  // namespace transillum
