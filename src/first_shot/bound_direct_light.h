/// Keeps points that stand for surfaces from shining brighter than these.
#pragma once

#include <transillum/base/parallel.h>
#include <transillum/first_shot/direct_light.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>

namespace transillum {

/// Emitting surfaces fill at most the hemisphere above a patch, a projected solid angle of pi. A
/// point that stands for a piece of one shines without bound on what is closer to it than the piece
/// is wide. What is more than pi there is spread over what else it lights close to its piece, where
/// its flux would go had it been spread over that: behind a screen before the lamp, say, and not
/// past it. Where all that is full, over all the point lights, in proportion.
void bound_direct_light(const SurfaceMesh& mesh, const PatchHierarchy& patches, DirectLight& light,
                        const Workers& workers);

}  // namespace transillum
