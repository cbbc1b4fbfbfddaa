#include "transport/residual_effect.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace transillum {

void ResidualEffect::add(const MonteCarloComponent& residual, const Workers& workers) {
    constexpr std::size_t grain = 16384;
    workers.for_ranges(elements_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
        for (auto p = static_cast<std::uint32_t>(begin); p < end; ++p) {
            const Arrived& a = residual.arrived(slot_of_patch(p, leaf_count_));
            elements_[p] += double{luminance(a.radiance)} * a.coverage;
        }
    });
}

void ResidualEffect::take(std::uint32_t patch, const Received& all) {
    Half& half = halves_[patch][half_];
    half.residual += luminance(all.radiance) - std::exchange(elements_[patch], 0.0);
    half.coverage += all.coverage;
}

double ResidualEffect::root_mean_square(std::span<const double> leaf_area) const {
    double sum = 0.0, area = 0.0;
    for (std::uint32_t p = 0; p < halves_.size(); ++p) {
        const auto& [first, second] = halves_[p];
        if (first.coverage == 0.0 || second.coverage == 0.0) continue;
        const double a = leaf_area[p < leaf_count_ ? p : p - leaf_count_];
        area += a;
        sum += a * (first.residual / first.coverage) * (second.residual / second.coverage);
    }
    return area > 0.0 ? std::sqrt(std::max(0.0, sum / area)) : 0.0;
}

}  // namespace transillum
