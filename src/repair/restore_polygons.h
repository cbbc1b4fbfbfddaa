/// From triangles back to the polygons of a scene.
#pragma once

#include <transillum/repair/triangle_soup.h>

namespace transillum {

/// Polygons whose triangles are as they were made stay as they are; triangles that were
/// turned are turned; of others, every triangle that is left becomes a polygon. Triangles that
/// stand for both sides get a material of which both sides reflect (and emit).
/// \param made what make_soup gave for `scene`; \param left what became of it, polygon by polygon,
/// its positions those of `made` and then new ones, or moved
[[nodiscard]] Scene restore_polygons(const Scene& scene, const TriangleSoup& made,
                                     const TriangleSoup& left);

}  // namespace transillum
