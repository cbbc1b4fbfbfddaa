/// Closed forms of illumination that tests compare with.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <vector>

namespace transillum::testing_support {

/// Irradiance at a point of unit normal from a Lambertian polygon of unit radiance above its
/// horizon: 1/2 of the sum over edges of the angle subtended times the edge plane's unit normal, on
/// n.
inline double polygon_irradiance(const std::vector<glm::dvec3>& corners, const glm::dvec3& point,
                                 const glm::dvec3& n) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - point);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - point);
        const glm::dvec3 across = glm::cross(a, b);
        const double sine = glm::length(across);
        if (sine > 0.0) sum += std::atan2(sine, glm::dot(a, b)) / sine * across;
    }
    return 0.5 * std::abs(glm::dot(sum, n));
}

/// Mean and its standard error from independent values.
struct Estimate {
    double mean = 0.0, error = 0.0;
};
inline Estimate estimate(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    Estimate e;
    for (const double v : values) e.mean += v / n;
    for (const double v : values) e.error += (v - e.mean) * (v - e.mean) / (n * (n - 1.0));
    e.error = std::sqrt(e.error);
    return e;
}

}  // namespace transillum::testing_support
