/// Straight free ways between sides, and from sides to outside.
#pragma once

#include "repair/defects/triangle_tree.h"
#include "repair/leaks/side_graph.h"

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>

namespace transillum {

struct Way {
    static constexpr Side outside = 0xffffffffu;

    Side from = 0, to = outside;
    double length = 0.0;  ///< from the centre of `from`, along its normal
};

/// The side of what a ray meets that looks against it.
[[nodiscard]] Side side_met(const TriangleSoup& soup, std::uint32_t triangle,
                            const glm::dvec3& direction);

/// From the centres of sides along their normals to what is there first: from every side of a part
/// of few, from at most a few thousand, evenly chosen, of others. By `from`.
/// \param part of every side, as SideGraph::find_parts
/// \param reach length of a ray's direction; ways to outside are that long
/// \returns where a stop is requested, only some of them
[[nodiscard]] std::vector<Way> find_ways(const TriangleSoup& soup, const TriangleTree& tree,
                                         const std::vector<std::uint32_t>& part, double reach,
                                         const Workers& workers, const Monitor& monitor);

}  // namespace transillum
