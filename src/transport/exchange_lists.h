/// What all exchanges along the lists of a tile have in common.
#pragma once

#include "transport/exchange.h"

#include <bit>
#include <cstdint>

namespace transillum {

/// Every fourth row of pixels, from a random one, suffices for the few numbers that clusters
/// exchange.
inline constexpr int cluster_row_stride = 4;
/// Cluster sums collect far more fragments than a patch does: they drop this many low bits.
inline constexpr int cluster_shift = 8;

/// What clusters add up of radiance that is not negative.
[[nodiscard]] inline FixedRadiance shifted(const FixedRadiance& r) {
    using Unsigned = std::uint64_t __attribute__((vector_size(32)));
    const Unsigned bits =
        (reinterpret_cast<const Unsigned&>(r.lane) >> cluster_shift) | Unsigned{0, 0, 0, 1};
    return {reinterpret_cast<const FixedRadiance::Lanes&>(bits)};
}
/// The same of any sign, below 2^61, rounded: cut off, small negative ones would count, positive
/// ones not. No processor before AVX-512 shifts 64-bit lanes with a sign.
[[nodiscard]] inline FixedRadiance shifted_signed(const FixedRadiance& r) {
    constexpr std::int64_t bias = std::int64_t{1} << 62;
    constexpr std::int64_t half = bias + (1 << (cluster_shift - 1));
    const FixedRadiance above{r.lane + FixedRadiance::Lanes{half, half, half, 0}};
    constexpr std::int64_t less = bias >> cluster_shift;
    return {shifted(above).lane - FixedRadiance::Lanes{less, less, less, 0}};
}

/// Slots of the sides of a fragment.
[[nodiscard]] inline std::uint32_t upper_slot(Fragment f) {
    return std::rotl(static_cast<std::uint32_t>(f),
                     1);  // leaf * 2 + whether the front faces forwards
}
[[nodiscard]] inline std::uint32_t lower_slot(Fragment f) {
    return upper_slot(f) ^ 1u;
}

}  // namespace transillum
