/// Keeps materials within what light transport can converge for.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

namespace transillum {

/// Scales, per channel, both lobes of every material whose albedo exceeds `max_albedo` down to it,
/// texel by texel in new textures where they have textures, and warns with the material's name,
/// what it reflected and how much of the reflected energy that removes. \pre max_albedo in (0, 1];
/// \throws UsageError otherwise.
void limit_albedo(Scene& scene, float max_albedo, Monitor& monitor);

}  // namespace transillum
