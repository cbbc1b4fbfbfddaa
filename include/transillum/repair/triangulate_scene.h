/// A scene's polygons as triangles, for formats that hold no others.
#pragma once

#include <transillum/scene/scene.h>

#include <cstdint>

namespace transillum {

struct TriangulationReport {
    std::uint64_t polygons = 0;      ///< of more than three corners, which were cut
    std::uint64_t without_area = 0;  ///< of these, such that give no triangle
};

/// Cuts every polygon of more than three corners (constrained Delaunay), in its place and with its
/// material, object, source face and UVs. Positions and triangles are left as they are.
TriangulationReport triangulate_scene(Scene& scene);

}  // namespace transillum
