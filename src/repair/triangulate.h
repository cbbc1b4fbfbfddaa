/// Polygons to triangles by constrained Delaunay triangulation (CGAL, exact predicates).
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

/// Triangulates a closed polygon that may be concave, repeat corners, run collinear or touch itself
/// along a seam (an outline that leaves and re-enters a hole along the same edge). It is projected
/// along its area vector; a point is inside where an odd number of distinct outline edges separates
/// it from outside. An outline that crosses itself has no such reading without new corners and is
/// cut into a fan. \returns triples of positions in `outline` (0-based), turning as the polygon
/// does; empty without area.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(
    std::span<const glm::dvec3> outline);

}  // namespace transillum
