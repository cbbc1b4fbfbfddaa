/// Makes planes of what lies in one plane but for the rounding of its coordinates.
#pragma once

#include "repair/exact/exact_kernel.h"

#include <transillum/repair/triangle_soup.h>

#include <unordered_map>

namespace transillum {

/// Vertices that are thought to be elsewhere than on their doubles.
struct FlatVertices {
    std::unordered_map<std::uint32_t, Exact::Point_3> positions;
    double furthest = 0.0;  ///< that one is moved, about [scene units]
};

/// Triangles that overlap each other within `tolerance` [scene units] of each other's planes, and
/// chains of these, are taken for parts of one plane, that of the largest. Their vertices are moved
/// to the planes of all the triangles they are corners of, exactly: walls that are not parallel to
/// an axis overlap exactly too then, though no doubles are in their plane. A vertex that would move
/// further than twice the tolerance stays. \returns nothing where all is exactly in its planes
[[nodiscard]] FlatVertices flatten(const TriangleSoup& soup, double tolerance);

}  // namespace transillum
