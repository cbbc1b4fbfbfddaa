/// Numbers without rounding (CGAL).
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <glm/vec3.hpp>

namespace transillum {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

[[nodiscard]] inline Exact::Point_3 exact_point(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

}  // namespace transillum
