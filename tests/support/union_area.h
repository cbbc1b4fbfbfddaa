/// How much area triangles cover.
#pragma once

#include <transillum/repair/triangle_soup.h>

#include <cstdint>

namespace transillum::testing_support {

struct UnionArea {
    double covered = 0.0;           ///< area that overlaps in a plane counted once
    double sum = 0.0;               ///< of all faces
    std::uint64_t clusters = 0;     ///< of faces that overlap in planes
    std::uint64_t overlapping = 0;  ///< faces in them
};

/// Faces that share area of one plane are found with exact predicates and united as polygons with
/// exact coordinates, projected onto the plane of the largest; the others count as they are.
/// Independent of how a repair resolves overlaps.
/// \param tolerance how far their corners may be from each other's planes [scene units]
[[nodiscard]] UnionArea union_area(const TriangleSoup& soup, double tolerance = 0.0);

}  // namespace transillum::testing_support
