/// Where a path passes the borders of surfaces.
#pragma once

#include "repair/leaks/side_graph.h"

#include <transillum/base/parallel.h>

#include <limits>
#include <span>

namespace transillum {

/// Closest points of an edge and a path.
struct Pass {
    glm::dvec3 on_edge{}, on_path{};
    double distance = std::numeric_limits<double>::infinity();
    std::size_t edge = 0;  ///< of the border
};

/// One a border edge, the closest first.
[[nodiscard]] std::vector<Pass> find_passes(const TriangleSoup& soup,
                                            const std::vector<SideGraph::BorderEdge>& border,
                                            std::span<const glm::dvec3> path,
                                            const Workers& workers);

}  // namespace transillum
