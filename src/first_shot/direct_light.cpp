#include <transillum/first_shot/direct_light.h>

#include <glm/geometric.hpp>

namespace transillum {

glm::dvec3 way_to_light(const LightSample& sample, const glm::dvec3& point) {
    return sample.kind == LightSample::Kind::directional ? -sample.normal : sample.position - point;
}

std::pair<std::size_t, std::size_t> DirectLight::samples_of(std::size_t column) const {
    if (!has_vectors()) return {column, column + 1};
    const bool is_last = column + 1 == first_samples.size();
    return {first_samples[column], is_last ? samples.size() : first_samples[column + 1]};
}

double DirectLight::share(std::size_t patch, std::size_t column) const {
    const std::size_t entry = patch * columns() + column;
    return has_vectors() ? glm::length(glm::dvec3(vectors[entry]))
                         : double{visibility[entry]} * geometry_factor[entry];
}

void DirectLight::scale(std::size_t patch, std::size_t column, double factor) {
    const std::size_t entry = patch * columns() + column;
    if (has_vectors())
        vectors[entry] *= static_cast<float>(factor);
    else
        geometry_factor[entry] = static_cast<float>(factor * geometry_factor[entry]);
}

glm::dvec3 DirectLight::direction(std::size_t patch, std::size_t column,
                                  const glm::dvec3& point) const {
    if (has_vectors()) return vectors[patch * columns() + column];
    return way_to_light(samples[column], point);
}

}  // namespace transillum
