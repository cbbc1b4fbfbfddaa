/// What must not be reached from outside.
#pragma once

#include "repair/defects/triangle_tree.h"
#include "repair/leaks/side_graph.h"

#include <string>

namespace transillum {

struct LeakSource {
    std::string name;                 ///< "luminaire 'lamp'", "camera 'front'", "light 'bulb'"
    std::vector<Side> sides;          ///< that emit, or that an eye or light in `position` sees
    std::vector<glm::dvec3> seen_at;  ///< one a side: where; empty: the sides themselves emit
    glm::dvec3 position{};
    std::vector<glm::dvec3> free;  ///< directions from the position that meet nothing
};

/// Does a scene have any?
[[nodiscard]] bool has_leak_sources(const Scene& scene);

/// Objects with faces that emit, from the sides that do; point and spot lights, looking six ways;
/// cameras, looking ahead.
[[nodiscard]] std::vector<LeakSource> find_leak_sources(const TriangleSoup& soup,
                                                        const Scene& scene,
                                                        const TriangleTree& tree, double reach);

}  // namespace transillum
