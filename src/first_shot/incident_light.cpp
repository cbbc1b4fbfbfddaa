#include <transillum/first_shot/direct_light.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace transillum {

Incident incident_light(const LightSample& sample, const Lighting& lighting,
                        const glm::dvec3& point) {
    if (sample.kind == LightSample::Kind::directional)
        return {-sample.normal, std::numeric_limits<double>::infinity(), sample.emitted};
    const glm::dvec3 way = sample.position - point;
    const double squared = glm::dot(way, way), distance = std::sqrt(squared);
    if (!(distance > 0.0)) return {};
    const glm::dvec3 direction = way / distance;
    const double strength = sample.kind == LightSample::Kind::area
                                ? sample.area * std::max(0.0, -glm::dot(sample.normal, direction))
                                : lighting.lights[sample.light].distribution(-direction);
    return {direction, distance, sample.emitted * static_cast<float>(strength / squared)};
}

}  // namespace transillum
