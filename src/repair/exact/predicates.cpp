#include "repair/exact/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace transillum {

bool are_collinear(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
    return CGAL::collinear(Point(a.x, a.y, a.z), Point(b.x, b.y, b.z), Point(c.x, c.y, c.z));
}

}  // namespace transillum
