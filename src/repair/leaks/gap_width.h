/// How narrow it is where one passes the border of a surface.
#pragma once

#include "repair/defects/triangle_tree.h"
#include "repair/leaks/side_graph.h"

#include <transillum/base/parallel.h>

#include <span>

namespace transillum {

struct Gap {
    double width = 0.0;  ///< infinite where nothing is ahead
    glm::dvec3 place{};  ///< of the path, where it passes there
};

/// The narrowest gap that a path passes: at the point of each border edge that is closest to it,
/// from there past the path to the nearest surface ahead. Looked at in the plane across the edge,
/// on the side away from its face; where the path touches the edge, in the half-plane; else within
/// 60 degrees of the direction to the path. Faces at the edge's vertices are left out.
/// \param limit gaps below it are all found; of wider ones only those at the few edges that the
/// path passes most closely are measured
/// \param touching distance below which the path touches the edge
[[nodiscard]] Gap narrowest_gap(const TriangleSoup& soup, const TriangleTree& tree,
                                const std::vector<SideGraph::BorderEdge>& border,
                                std::span<const glm::dvec3> path, double limit, double touching,
                                const Workers& workers);

}  // namespace transillum
