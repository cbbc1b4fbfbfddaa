/// Iteration on some of the roots, with results and sums of all.
#pragma once

#include <transillum/transport/iterate.h>

#include <cstdint>
#include <span>

namespace transillum {

/// As iterate(), as if the roots that are left out were not there. Their patches receive nothing
/// and are never covered, and errors are over the mean of what is left. What was summed up can be
/// gone on with by this or by iterate().
/// \param left_out one a root. \pre as of iterate(), and directional_emission is empty, and some
/// root stays
[[nodiscard]] TransportResult iterate_without(std::span<const std::uint8_t> left_out,
                                              const SurfaceMesh& mesh,
                                              const PatchHierarchy& patches,
                                              const PatchSources& sources,
                                              const IterationOptions& options,
                                              const Workers& workers, Monitor& monitor);

}  // namespace transillum
