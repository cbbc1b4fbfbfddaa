#include "transport/relative_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace transillum {

double estimate_relative_error(const FiniteElementComponent& component,
                               std::span<const double> leaf_area, const Workers& workers) {
    struct Sums {
        double variance = 0.0, mean = 0.0, seen = 0.0, unseen = 0.0, untold = 0.0;
    };
    constexpr std::uint32_t range = 1 << 14;  // fixed, so that sums don't depend on the threads
    std::vector<Sums> partial(component.patch_count() / range + 1);
    workers.for_ranges(partial.size(), 1, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t r = begin; r < end; ++r) {
            const auto first = static_cast<std::uint32_t>(r * range);
            for (std::uint32_t p = first; p < std::min(first + range, component.patch_count());
                 ++p) {
                const double area = leaf_area[p % leaf_area.size()];
                const bool seen = component.coverage(p) > 0.0;
                (seen ? partial[r].seen : partial[r].unseen) += area;
                if (!seen) continue;
                partial[r].mean += area * luminance(component.incoming(p));
                const double variance = luminance(component.incoming_variance(p));
                if (std::isnan(variance))
                    partial[r].untold += area;
                else
                    partial[r].variance += area * variance;
            }
        }
    });
    Sums all;
    for (const Sums& s : partial) {
        all.mean += s.mean;
        all.variance += s.variance;
        all.seen += s.seen;
        all.unseen += s.unseen;
        all.untold += s.untold;
    }
    if (all.seen == 0.0) return std::numeric_limits<double>::quiet_NaN();
    if (all.mean == 0.0) return 0.0;
    // Fewer might seem to agree by chance.
    constexpr int least_blocks = 8;
    if (component.blocks() < least_blocks) return std::numeric_limits<double>::quiet_NaN();
    // Of a patch that hardly any direction has met nothing is known: an error as large as the mean.
    const double mean = all.mean / all.seen;
    return std::sqrt((all.variance + (all.unseen + all.untold) * mean * mean) /
                     (all.seen + all.unseen)) /
           mean;
}

}  // namespace transillum
