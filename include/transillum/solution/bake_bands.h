/// The whole pipeline in bands of wavelengths: geometry, patches and the first shot's visibility
/// are found once, and every group of three bands is then transported as RGB is.
#pragma once

#include <transillum/scene/measured_materials.h>
#include <transillum/solution/bake.h>
#include <transillum/solution/spectral_solution.h>

namespace transillum {

/// As bake. Refinement looks at RGB. A limit of time is parted among the groups; a wish to stop
/// leaves those still to come with direct light alone. \throws what bake throws; UsageError for a
/// number of bands out of range.
[[nodiscard]] SpectralSolution bake_bands(const Scene& scene, const SpectralOptions& spectral,
                                          const BakeOptions& options, const Workers& workers,
                                          Monitor& monitor, RunRecord* run = nullptr);

}  // namespace transillum
