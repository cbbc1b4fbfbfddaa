/// Keeps materials within what light transport can converge for.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

namespace transillum {

/// Scales, per channel, both lobes of every material that reflects more than `max_albedo` down to
/// it, texel by texel in new textures where they have textures: max-Phong at whatever angle; GGX
/// along the normal and of uniform light, which is what light between surfaces dies out by (at
/// grazing angles any smooth surface mirrors all light, however little it reflects elsewhere). A
/// GGX limit below 0.05 is held only by leaving the lobe out. It warns with the material's name,
/// what it reflected and how much of the reflected energy that removes. \pre max_albedo in (0, 1];
/// \throws UsageError otherwise.
void limit_albedo(Scene& scene, float max_albedo, Monitor& monitor);

}  // namespace transillum
