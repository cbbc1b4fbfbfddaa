/// Groups of root triangles that lie in one plane, face the same way and hang together by edges.
#pragma once

#include <transillum/geometry/surface_mesh.h>

#include <cstdint>
#include <vector>

namespace transillum {

/// Number of its group, one a root; roots of a group know each other by shared edges.
[[nodiscard]] std::vector<std::uint32_t> coplanar_groups(const SurfaceMesh& mesh);

}  // namespace transillum
