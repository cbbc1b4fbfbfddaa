/// What an iteration has summed up, so that another can go on from it, on other elements of the
/// same surface: after a split, children inherit the sums (paper §3.2).
#pragma once

#include "transport/exchange.h"
#include "transport/finite_elements.h"
#include "transport/relative_error.h"

#include <transillum/geometry/leaf_shares.h>
#include <transillum/transport/iterate.h>

#include <cstdint>

namespace transillum {

struct IterationSums {
    PatchHierarchy patches;
    std::vector<GlossySide> sides;
    double pixel_size = 0.0;  ///< sums count fragments
    std::uint64_t directions = 0;
    FiniteElementSums elements;
    ClusterTransfer between_clusters{0};
    ErrorHistory error;
};

/// The elements' sums, as they would be on other patches and bins: a part of a patch takes its
/// share of all, a union of patches all of theirs. Exact but for the spread of blocks, which a
/// union takes for as large as it may be.
[[nodiscard]] FiniteElementSums inherited(const IterationSums& sums, const PatchHierarchy& patches,
                                          const GlossySides& glossy, double pixel_size);

}  // namespace transillum
