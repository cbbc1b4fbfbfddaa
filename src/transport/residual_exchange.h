/// Exchange along lists whose points send a residual beside what their patches send.
#pragma once

#include "transport/exchange_lists.h"
#include "transport/monte_carlo_component.h"

namespace transillum {

/// Both sides of a fragment: the slots of their patches, and what they send beside them.
struct ResidualPoint {
    std::uint32_t lower = 0, upper = 0;
    FixedRadiance from_lower, from_upper;
};

/// \param layer point(fragment, index within the tile, column, row) -> ResidualPoint;
/// arrive_at_lower(point, index, radiance), arrive_at_upper likewise
/// \param carried everything: it is told all that arrives; else, what the finite elements sent
template <class Layer>
void exchange_with_residual(const TileLists& tile, const ExchangeTables& tables, int cluster_row,
                            Carried carried, ExchangeTally& tally, Layer& layer) {
    const std::uint32_t outside = 2 * tables.leaf_count;
    const std::uint32_t n = tables.cluster_count + 1;
    FixedRadiance escaped, entered;
    const bool received = carried != Carried::nothing;
    const auto receive = [&](std::uint32_t slot, const FixedRadiance& radiance) {
        if (received) tally.received[slot] += radiance;
    };
    const auto tell_clusters = [&](std::uint32_t a, const FixedRadiance& by_a, std::uint32_t b,
                                   const FixedRadiance& by_b) {
        tally.transfer[tables.cluster[a] * n + tables.cluster[b]] += shifted_signed(by_b);
        tally.transfer[tables.cluster[b] * n + tables.cluster[a]] += shifted_signed(by_a);
    };
    // A residual brings no coverage of its own.
    const auto sum = [](const FixedRadiance& radiance, const FixedRadiance& residual) {
        FixedRadiance s = radiance;
        s += residual;
        s.lane[3] = 1;
        return s;
    };
    for (int row = 0; row < tile.height; ++row) {
        const bool sampled =
            received && cluster_row >= 0 && (tile.row0 + row) % cluster_row_stride == cluster_row;
        for (int column = 0; column < tile.width; ++column) {
            const int pixel = row * tile.width + column;
            std::uint32_t i = tile.first[pixel];
            const std::uint32_t end = tile.first[pixel + 1];
            if (i == end) continue;
            const auto point = [&](std::uint32_t k) {
                return layer.point(tile.fragments[k], k, tile.column0 + column, tile.row0 + row);
            };
            // The first and the last of a list face the environment.
            ResidualPoint behind = point(i);
            FixedRadiance sent = sum(tables.radiance[behind.lower], behind.from_lower);
            receive(behind.lower, tables.along);
            layer.arrive_at_lower(behind, i, tables.along);
            entered += tables.along;
            escaped += sent;
            if (sampled) tell_clusters(outside, tables.along, behind.lower, sent);
            for (++i; i != end; ++i) {
                const ResidualPoint ahead = point(i);
                const FixedRadiance forwards = tables.radiance[behind.upper];
                const FixedRadiance backwards = tables.radiance[ahead.lower];
                const FixedRadiance all_forwards = sum(forwards, behind.from_upper);
                const FixedRadiance all_backwards = sum(backwards, ahead.from_lower);
                receive(ahead.lower, all_forwards);
                receive(behind.upper, all_backwards);
                layer.arrive_at_lower(ahead, i,
                                      carried == Carried::everything ? all_forwards : forwards);
                layer.arrive_at_upper(behind, i - 1,
                                      carried == Carried::everything ? all_backwards : backwards);
                if (sampled) tell_clusters(ahead.lower, all_backwards, behind.upper, all_forwards);
                behind = ahead;
            }
            sent = sum(tables.radiance[behind.upper], behind.from_upper);
            receive(behind.upper, tables.against);
            layer.arrive_at_upper(behind, i - 1, tables.against);
            entered += tables.against;
            escaped += sent;
            if (sampled) tell_clusters(behind.upper, sent, outside, tables.against);
        }
    }
    if (received) {
        tally.received[outside] += escaped;
        tally.entered += entered;
    }
    tally.fragments += tile.fragments.size();
}

}  // namespace transillum
