/// Makes a path along surfaces as straight as what stands in its way allows.
#pragma once

#include "repair/defects/triangle_tree.h"
#include "repair/leaks/side_graph.h"

namespace transillum {

/// A point of a path: in free space, on a side, or on an edge between two sides.
struct PathPoint {
    static constexpr Side none = 0xffffffffu;

    glm::dvec3 position{};
    Side side = none;          ///< where it is on one, or comes over the edge from
    Side next = none;          ///< where the edge leads to
    std::uint32_t corner = 0;  ///< of the edge, in the triangle of `side`
};

/// Leaves points out wherever the straight way between two others meets nothing and stays on their
/// sides. First and last stay.
[[nodiscard]] std::vector<PathPoint> pull_string(const TriangleSoup& soup, const TriangleTree& tree,
                                                 std::vector<PathPoint> path);

}  // namespace transillum
