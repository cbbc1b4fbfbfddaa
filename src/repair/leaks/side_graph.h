/// The sides of triangles, and how one gets from one to the next over their edges: what a fly can
/// walk on.
#pragma once

#include "repair/defects/edge_table.h"

#include <cstdint>
#include <vector>

namespace transillum {

/// 2 * triangle for its front, one more for its back.
using Side = std::uint32_t;

[[nodiscard]] glm::dvec3 centre_of(const TriangleSoup& soup, std::uint32_t triangle);
/// Away from the side; unit.
[[nodiscard]] glm::dvec3 outward_of(const TriangleSoup& soup, Side side);

/// At each edge its faces' sides are joined in the order in which they lie around it (exact
/// predicates), the front and back of a border edge's one face too.
class SideGraph {
public:
    /// \pre triangles meet in shared vertices and edges only
    explicit SideGraph(const TriangleSoup& soup);

    [[nodiscard]] std::uint32_t side_count() const {
        return static_cast<std::uint32_t>(across_.size() / 3);
    }
    /// What the edge from `corner` to the next leads to.
    [[nodiscard]] Side across(Side side, std::uint32_t corner) const {
        return across_[3 * side + corner];
    }
    struct BorderEdge {
        std::uint32_t triangle = 0, corner = 0;
    };
    [[nodiscard]] const std::vector<BorderEdge>& border() const { return border_; }
    /// Numbers from 0 of what hangs together by edges, one a side.
    [[nodiscard]] std::vector<std::uint32_t> find_parts() const;

private:
    std::vector<Side> across_;
    std::vector<BorderEdge> border_;
};

}  // namespace transillum
