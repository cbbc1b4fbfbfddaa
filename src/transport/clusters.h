/// Groups of root sides that the energy balance treats as one unknown each.
#pragma once

#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>

#include <cstdint>
#include <vector>

namespace transillum {

inline constexpr std::uint32_t most_clusters = 48;

struct Clusters {
    std::uint32_t count = 0;
    std::vector<std::uint8_t> of_patch;  ///< one a patch, then `count` for the environment
};

/// Splits all root sides, again and again where area times spread is largest, at the middle of
/// their widest extent in position (relative to the scene) and normal: walls of different rooms,
/// and the sides of a wall, come apart. Sides that neither reflect nor emit, as black backs, are a
/// cluster of their own: among others they would only blur what these receive.
[[nodiscard]] Clusters make_clusters(const SurfaceMesh& mesh, const PatchHierarchy& patches);

}  // namespace transillum
