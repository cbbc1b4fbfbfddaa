/// Moves vertices that are too close for their coordinates.
#pragma once

#include "repair/exact/find_intersections.h"

namespace transillum {

/// Rounds the vertices of triangles that meet where they should not, and all that share a cell with
/// one of these, to a grid of the given spacing; those that come together become one. What is cut
/// after that has room between its coordinates for vertices that are rounded finely (Valque and
/// Lazard, "Removing self-intersections in 3D meshes while preserving floating-point coordinates").
/// \param spacing a power of two [scene units] \returns the furthest that a vertex was moved
double coarsen(TriangleSoup& soup, const std::vector<MeetingPair>& pairs, double spacing);

/// Puts another vertex in the place of each: `target[v]`, itself where it stays.
void replace_vertices(TriangleSoup& soup, const std::vector<std::uint32_t>& target);

}  // namespace transillum
