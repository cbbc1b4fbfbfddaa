/// The average of the finite elements while it is built (paper eq. 5, design 4.4): what is summed
/// up, when it begins anew, when it is balanced, and how far it may be off.
#pragma once

#include "transport/clusters.h"
#include "transport/exchange.h"
#include "transport/finite_elements.h"
#include "transport/iteration_sums.h"
#include "transport/relative_error.h"
#include "transport/residual_effect.h"

#include <transillum/transport/iterate.h>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace transillum {

/// Number of directions after which the estimate is balanced for the first time.
inline constexpr std::uint64_t first_balance = 8;

class RunningAverage {
public:
    /// Keeps references.
    RunningAverage(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                   const PatchSources& sources, Averaging averaging, const Workers& workers);

    /// Goes on from an earlier run's. \param are_same they are of just these elements
    void go_on_from(const IterationSums& sums, const PatchHierarchy& patches,
                    const GlossySides& glossy, double pixel_size, bool are_same);
    /// Adds what another needs to go on from here.
    void keep(IterationSums& sums) const;

    /// So far.
    [[nodiscard]] std::uint64_t directions() const { return done_; }
    [[nodiscard]] FiniteElementComponent& elements() { return elements_; }
    [[nodiscard]] const FiniteElementComponent& elements() const { return elements_; }
    [[nodiscard]] const Clusters& clusters() const { return clusters_; }
    [[nodiscard]] std::span<const double> leaf_area() const { return leaf_area_; }

    /// Of each direction of a block of so many.
    [[nodiscard]] double weight_after(std::uint64_t directions) const;
    /// Notes a bound of what the environment sends along the next block.
    void meet_environment(float brightest);

    /// Begins anew where that is due: before a block.
    void begin_block();
    /// Whether at the next power of two the average becomes one of something else.
    void set_begins_anew(bool begins_anew) { begins_anew_ = begins_anew; }
    /// Takes a block. \param is_even whether all directions with it form nets
    /// \param effect told what every patch received, where given
    void end_block(Exchange& exchange, std::uint64_t directions, bool is_even,
                   ResidualEffect* effect);
    /// Makes the best of what there is: there is no other block to come.
    void conclude();

    /// Of the irradiance; NaN where unknown.
    [[nodiscard]] double relative_error() const { return relative_error_; }
    /// Its own relative standard error.
    [[nodiscard]] double relative_error_uncertainty() const { return error_.uncertainty(); }
    void estimate_relative_error() { relative_error_ = error_.relative_error(elements_); }
    /// See ErrorEstimate.
    [[nodiscard]] double correction() const { return error_.correction(elements_); }

private:
    [[nodiscard]] bool balances_at(std::uint64_t done) const;
    void balance();
    void limit();
    void recall();
    void forget();

    const Averaging averaging_;
    const Workers& workers_;
    Clusters clusters_;
    ClusterTransfer between_clusters_, earlier_between_clusters_;
    FiniteElementComponent elements_;
    std::vector<double> leaf_area_;
    ErrorEstimate error_;
    float brightest_ = 0.0f;  ///< of the environment, so far
    bool begins_anew_ = false;
    std::uint64_t done_ = 0, restarted_at_ = 0;
    double relative_error_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace transillum
