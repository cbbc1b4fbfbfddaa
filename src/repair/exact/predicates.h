/// Exact predicates (CGAL).
#pragma once

#include <glm/vec3.hpp>

namespace transillum {

/// Do three points lie on one line? Exact for any finite coordinates.
[[nodiscard]] bool are_collinear(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace transillum
