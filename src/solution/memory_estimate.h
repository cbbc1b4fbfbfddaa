/// What a bake is going to need, before it is taken.
#pragma once

#include <transillum/first_shot/light_samples.h>
#include <transillum/solution/solution.h>

#include <cstdint>

namespace transillum {

/// [bytes]
struct MemoryEstimate {
    std::uint64_t patches = 0;     ///< the iteration's sums and results
    std::uint64_t first_shot = 0;  ///< tables of light samples or vectors by patches
    std::uint64_t direction_bins = 0;
    std::uint64_t monte_carlo = 0;  ///< what is carried from bundle to bundle
    std::uint64_t band_groups = 0;  ///< results that are kept of every group of bands
    std::uint64_t kept_sums = 0;    ///< for a bake that goes on

    [[nodiscard]] std::uint64_t total() const {
        return patches + first_shot + direction_bins + monte_carlo + band_groups + kept_sums;
    }
};

/// Of a copy of the sums, and of what is made of it to be written.
[[nodiscard]] std::uint64_t kept_sums_bytes(const Solution& solution);

/// All but `monte_carlo` and `kept_sums`, which the caller fills in. \pre the surface, patches and
/// glossy sides are known.
[[nodiscard]] MemoryEstimate estimate_memory(const Solution& solution, const Luminaires& luminaires,
                                             int threads, std::uint64_t band_groups = 0);

/// \throws UsageError saying what needs how much and what to change, where the total exceeds
/// `limit` [bytes]; 0 is no limit.
void require_memory(const MemoryEstimate& estimate, std::uint64_t limit);

}  // namespace transillum
