/// The incoming first shot: a hemicube at every light sample (paper §4), two back to back at a
/// point light, a parallel projection for a directional one.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/first_shot/direct_light.h>
#include <transillum/first_shot/light_samples.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>

namespace transillum {

/// Finds what arrives at every patch from every sample of the luminaires. The hemicubes are turned
/// at random about their axes, so that their pixels don't fall alike. The window of a directional
/// light is a transillumination buffer with four pixels across the scene to one along a hemicube's
/// edge: first fragments are lit. A patch between its pixels' centres is lit where a ray from its
/// own centre meets nothing. Does not depend on the number of workers. When the monitor wants to
/// stop, nothing arrives from the samples that were still to come. Where the luminaires ask for
/// light vectors, samples are summed up as they are shot: their tables are never held.
[[nodiscard]] DirectLight shoot_direct_light(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                             const Luminaires& luminaires, int hemicube_resolution,
                                             const Workers& workers, Monitor& monitor);

/// Irradiance by first shot, one a patch [W m^-2].
[[nodiscard]] std::vector<Spectrum> direct_irradiance(const DirectLight& light,
                                                      std::uint32_t patch_count);

}  // namespace transillum
