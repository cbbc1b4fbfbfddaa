/// Exact subdivision of a whole scene, without T-junctions, for use elsewhere.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/repair/snap_grid.h>
#include <transillum/scene/scene.h>

#include <cstdint>

namespace transillum {

/// Exactly one of the two.
struct SceneSubdivision {
    double max_edge = 0.0;  ///< longest edge a triangle may have [scene units]
    int level = -1;         ///< every triangle becomes 4^level
};

struct SubdivisionReport {
    SnapGrid grid;
    std::uint64_t triangles_before = 0, triangles = 0;
    int deepest = 0;  ///< halvings on the way to the deepest triangle
};

/// More would be no mesh for other programs.
inline constexpr std::uint64_t most_subdivided_triangles = std::uint64_t{1} << 24;

/// Snaps the vertices to the dyadic grid, as a bake does, welds and triangulates; then halves edges
/// at midpoints that are exact in double. A triangle all of whose edges are halved is cut 1-to-4;
/// one with one or two such edges, in 2 or 3, a quadrilateral along its shorter diagonal. Whether
/// an edge is halved depends on its ends alone, so that triangles which share an edge share what
/// becomes of it: there are T-junctions only where the scene had them. Triangles keep object,
/// material and source face; UVs are interpolated linearly, and rounded once.
/// \throws UsageError unless exactly one limit is given, the level is in [0, max_subdivision_level]
/// and max_edge finite, above 0 and met within these levels, and above most_subdivided_triangles;
/// InputError as make_soup and where no triangle is left
[[nodiscard]] Scene subdivide_scene(const Scene& scene, const SceneSubdivision& options,
                                    Monitor& monitor, SubdivisionReport* report = nullptr);

}  // namespace transillum
