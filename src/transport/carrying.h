/// When the Monte-Carlo component is carried from bundle to bundle, and whether it is worth it.
#pragma once

#include "transport/bundle_transfer.h"
#include "transport/iteration_sums.h"
#include "transport/residual_effect.h"
#include "transport/running_average.h"

#include <transillum/transport/iterate.h>

#include <cstdint>
#include <limits>
#include <optional>

namespace transillum {

class Carrying {
public:
    /// Keeps references.
    Carrying(const PatchHierarchy& patches, const IterationOptions& options,
             BundleTransfer& transfer, RunningAverage& average, const Workers& workers)
        : patches_(patches),
          options_(options),
          transfer_(transfer),
          average_(average),
          workers_(workers) {}

    /// Goes on from an earlier run on the same elements.
    void go_on_from(const CarriedBefore& before);
    /// As another needs it to go on from where a block of which so many directions are done began.
    [[nodiscard]] CarriedBefore kept(std::uint64_t in_block) const;

    /// Before a block, after every direction, and after a block that the average has taken.
    void begin_block();
    void add_direction();
    void end_block();

    /// Most directions of a block.
    [[nodiscard]] std::uint64_t longest_block() const;
    /// Null unless it is being measured.
    [[nodiscard]] ResidualEffect* effect() { return effect_ ? &*effect_ : nullptr; }

    void tell(TransportResult& result) const;

private:
    [[nodiscard]] std::uint64_t first_direction() const;
    void begin();
    void decide();
    [[nodiscard]] std::uint64_t directions() const {
        return before_.directions + transfer_.carried();
    }

    const PatchHierarchy& patches_;
    const IterationOptions& options_;
    BundleTransfer& transfer_;
    RunningAverage& average_;
    const Workers& workers_;
    MonteCarlo representation_ = MonteCarlo::off;
    std::optional<ResidualEffect> effect_;  ///< while it is being measured
    std::uint64_t effect_begin_ = 0;
    double residual_effect_ = std::numeric_limits<double>::quiet_NaN();
    CarriedBefore before_;
    std::uint64_t anew_at_ = 0;
};

}  // namespace transillum
