/// What an iteration has summed up, so that another can go on from it, on other elements of the
/// same surface: after a split, children inherit the sums (paper §3.2).
#pragma once

#include "transport/exchange.h"
#include "transport/finite_elements.h"
#include "transport/relative_error.h"

#include <transillum/geometry/leaf_shares.h>
#include <transillum/transport/iterate.h>

#include <cstdint>
#include <limits>

namespace transillum {

/// How far the Monte-Carlo component had come. What it carried is not kept.
struct CarriedBefore {
    MonteCarlo representation = MonteCarlo::off;
    std::uint64_t directions = 0;
    std::uint64_t shuffled_from = 0, shuffled_until = 0;  ///< see DirectionOrder
    bool given_up = false;                                ///< found not to be worth it
    double effect = std::numeric_limits<double>::quiet_NaN();
};

/// As they are between two blocks of directions, before a run that ends there recalls what was set
/// aside and balances: one that goes on from them does what the other would have done.
struct IterationSums {
    PatchHierarchy patches;
    std::vector<GlossySide> sides;
    double pixel_size = 0.0;  ///< sums count fragments
    Averaging averaging = Averaging::balanced;
    MonteCarlo monte_carlo = MonteCarlo::off;
    std::uint64_t directions = 0;
    std::uint64_t restarted_at = 0;  ///< number of directions; 0: not yet
    FiniteElementSums elements, earlier;
    ClusterTransfer between_clusters{0}, earlier_between_clusters{0};
    CarriedBefore carried;
    ErrorHistory error;
    double relative_error = std::numeric_limits<double>::quiet_NaN();  ///< when last estimated
    bool restarts = false;               ///< the average is begun anew at the next power of two
    float brightest_environment = 0.0f;  ///< so far
};

/// Are they of just these elements, so that going on from them is exact?
[[nodiscard]] bool is_of(const IterationSums& sums, const PatchHierarchy& patches,
                         const GlossySides& glossy, double pixel_size);

/// The elements' sums, as they would be on other patches and bins: a part of a patch takes its
/// share of all, a union of patches all of theirs. Exact but for the spread of blocks, which a
/// union takes for as large as it may be. \param elements of `sums`: its own or the earlier ones
[[nodiscard]] FiniteElementSums inherited(const IterationSums& sums,
                                          const FiniteElementSums& elements,
                                          const PatchHierarchy& patches, const GlossySides& glossy,
                                          double pixel_size);

}  // namespace transillum
