/// The exact arrangement of what lies in one plane.
#pragma once

#include "repair/exact/exact_points.h"

#include <array>
#include <vector>

namespace transillum {

/// Triangles of one plane (one, or several that overlap or touch), with what others leave in it.
struct PlaneInput {
    std::vector<std::uint32_t> members;                  ///< triangles of the soup
    std::vector<std::uint32_t> points;                   ///< ExactPoints in members
    std::vector<std::array<std::uint32_t, 2>> segments;  ///< between ExactPoints, in members
};

struct PlanePart {
    std::uint32_t member = 0;  ///< the triangle that it is a part of, and turns as
    /// Numbers of ExactPoints; from their count on, of `made`.
    std::array<std::uint32_t, 3> corners{};
};

struct PlaneParts {
    std::vector<PlanePart> parts;  ///< of every member; where members overlap, on the same corners
    std::vector<Exact::Point_3> made;  ///< where segments cross
};

/// Constrained Delaunay triangulation of all edges, segments and points, exact.
[[nodiscard]] PlaneParts arrange_plane(const TriangleSoup& soup, const ExactPoints& points,
                                       const PlaneInput& input);

}  // namespace transillum
