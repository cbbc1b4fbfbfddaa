/// What the sharing of edges and vertices alone tells.
#pragma once

#include "repair/defects/defect_sites.h"

namespace transillum {

/// Counts edges of one face, of three or more, those whose two faces disagree, and vertices where
/// several fans meet: groups of faces that hang together by the edges at the vertex.
void check_edges(const TriangleSoup& soup, DefectSites& sites);

}  // namespace transillum
