/// Makes edges pass through the vertices that lie on them.
#pragma once

#include "repair/defects/find_defects.h"

namespace transillum {

/// Cuts each triangle at the vertices on one of its edges, into a fan around the opposite corner;
/// those on other edges are left for another call. No vertex moves: the edge does.
/// \param junctions by triangle, edge and parameter \returns how many were joined
std::uint64_t split_t_junctions(TriangleSoup& soup, const std::vector<TJunction>& junctions);

}  // namespace transillum
