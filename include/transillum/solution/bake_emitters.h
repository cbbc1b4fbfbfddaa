/// The whole pipeline, emitter by emitter: geometry, patches and what patches see of light samples
/// are found once, and the light of every emitter is then transported on its own.
#pragma once

#include <transillum/solution/bake.h>
#include <transillum/solution/emitter_solution.h>

namespace transillum {

/// As bake, with the same directions for every emitter. Refinement looks at all of them together.
/// With the paper's averaging, the sum is what bake gives but for rounding; the energy balance
/// weighs transfers with the light that they carried, so that otherwise the two differ within their
/// errors. A limit of time is parted among the emitters. \throws what bake throws.
[[nodiscard]] EmitterSolution bake_emitters(const Scene& scene, const BakeOptions& options,
                                            const Workers& workers, Monitor& monitor,
                                            RunRecord* run = nullptr);

}  // namespace transillum
