/// The passes of a repair, in their order.
#pragma once

#include <transillum/repair/repair_scene.h>
#include <transillum/repair/triangle_soup.h>

namespace transillum {

/// Positions are only added and (rarely) moved; triangles keep the order of their polygons.
/// \param scene what the soup was made of, for materials and messages
/// \param grid that coordinates are rounded to, where options.rounding is dyadic
void repair_soup(TriangleSoup& soup, const Scene& scene, const RepairOptions& options,
                 const SnapGrid& grid, const Workers& workers, Monitor& monitor,
                 RepairReport& report);

}  // namespace transillum
