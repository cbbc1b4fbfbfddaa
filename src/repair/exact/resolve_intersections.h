/// Cuts triangles where they meet, exactly, so that they meet in whole vertices and edges.
#pragma once

#include "repair/exact/find_intersections.h"

#include <transillum/base/monitor.h>
#include <transillum/repair/snap_grid.h>

namespace transillum {

struct Resolution {
    std::uint64_t faces_cut = 0, faces_made = 0, vertices_made = 0;
};

/// Replaces every triangle of a pair that has to be cut by its parts. The arrangement is exact: all
/// points are constructed from the soup's doubles with exact numbers, triangles that overlap in one
/// plane are cut alike (their common parts end up on the same vertices), and neighbours are cut
/// alike along their edge. Its new vertices are then rounded, once. \param round_to what a
/// coordinate may be; rounding may move vertices across faces, so look again.
/// \param flat see flatten.h: what the pairs were found with \pre no triangle without area
Resolution resolve_intersections(TriangleSoup& soup, const std::vector<MeetingPair>& pairs,
                                 const FlatVertices& flat, const VertexRounding& round_to,
                                 const Workers& workers, Monitor& monitor);

}  // namespace transillum
