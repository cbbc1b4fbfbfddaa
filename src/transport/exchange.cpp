#include "transport/exchange.h"

#include "transport/exchange_lists.h"
#include "transport/monte_carlo_component.h"

#include <transillum/base/sampling.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace transillum {

namespace {

/// Fragments between a fetch and its use: long enough for main memory, short enough to stay in the
/// cache.
constexpr std::ptrdiff_t fetch_distance = 24;

/// Uniform in [0, 1).
double draw_of(std::uint64_t draw, std::uint64_t patch) {
    return static_cast<double>(hash_bits(hash_bits(draw) ^ patch) >> 11) * 0x1p-53;
}

}  // namespace

Exchange::Exchange(std::uint32_t leaf_count, const Clusters& clusters, const Workers& workers)
    : leaf_count_(leaf_count),
      cluster_count_(clusters.count),
      workers_(workers),
      radiance_(2 * std::size_t{leaf_count}),
      tallies_(workers.count()) {
    if (cluster_count_ > 0) {
        cluster_.resize(radiance_.size() + 1);
        for (std::uint32_t p = 0; p < clusters.of_patch.size(); ++p)
            cluster_[slot_of(p)] = clusters.of_patch[p];
    }
    for (ExchangeTally& p : tallies_) {
        p.received.resize(radiance_.size() + 1);
        p.transfer.resize(std::size_t{cluster_count_ + 1} * (cluster_count_ + 1));
    }
    set_environment(Spectrum(0.0f), Spectrum(0.0f));
}

FixedRadiance Exchange::fixed(const Spectrum& radiance) const {
    const double a_unit = 1.0 / unit_;     // exact: a power of two
    constexpr double to_whole = 0x1.8p52;  // there doubles are whole numbers
    const auto steps = [&](float x) {
        const double cut_off = std::clamp(x * a_unit, -most_steps_, most_steps_);
        return static_cast<std::int64_t>(cut_off + to_whole - to_whole);
    };
    return {FixedRadiance::Lanes{steps(radiance.x), steps(radiance.y), steps(radiance.z), 1}};
}

FixedRadiance Exchange::rounded_at_random(const Spectrum& radiance, double draw) const {
    const double a_unit = 1.0 / unit_;
    const auto steps = [&](float x) {
        return static_cast<std::int64_t>(
            std::min(std::floor(double{x} * a_unit + draw), most_steps_));
    };
    return {FixedRadiance::Lanes{steps(radiance.x), steps(radiance.y), steps(radiance.z), 1}};
}

void Exchange::set_radiance(const std::vector<Spectrum>& radiance, float largest,
                            double most_fragments) {
    // largest < 2^exponent; a sum of most_fragments of them stays below 2^62.
    int exponent = 0;
    std::frexp(largest, &exponent);
    const int bits = std::min(40, 62 - static_cast<int>(std::ceil(std::log2(most_fragments))));
    unit_ = largest > 0.0f ? std::ldexp(1.0, exponent - bits) : 1.0;
    most_steps_ = std::ldexp(1.0, bits);
    bits_ = bits;
    workers_.for_ranges(radiance.size(), 16384, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i)
            radiance_[slot_of(static_cast<std::uint32_t>(i))] =
                rounded_at_random(radiance[i], draw_of(draw_, i));
    });
}

void Exchange::set_radiance(std::uint32_t patch, const Spectrum& radiance) {
    radiance_[slot_of(patch)] = fixed(radiance);
}

void Exchange::set_environment(const Spectrum& along, const Spectrum& against) {
    along_ = fixed(along);
    against_ = fixed(against);
}

Received Exchange::take_entered() {
    FixedRadiance sum;
    for (ExchangeTally& p : tallies_) {
        sum += p.entered;
        p.entered = {};
    }
    return in_units(sum, unit_);
}

// Integers: both versions give the same bits.
#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target_clones("avx2", "default")))
#endif
void Exchange::exchange_tile(const TileLists& tile, int cluster_row, ExchangeTally& tally) const {
    const std::uint32_t outside = 2 * leaf_count_;
    FixedRadiance* const received = tally.received.data();
    const FixedRadiance* const radiance = radiance_.data();
    const std::uint8_t* const cluster = cluster_.data();
    FixedRadiance* const transfer = tally.transfer.data();
    const std::uint32_t n = cluster_count_ + 1;
    FixedRadiance escaped, entered;
    const FixedRadiance along = along_, against = against_;
    // Lists lie one behind the other: the leaves of those to come are fetched ahead.
    const Fragment* const last = tile.fragments.data() + tile.fragments.size() - 1;
    const auto fetch_ahead = [&](const Fragment* f) {
        const std::uint32_t slot = upper_slot(*std::min(f + fetch_distance, last)) & ~1u;
        __builtin_prefetch(&radiance[slot]);
        __builtin_prefetch(&received[slot], 1);
    };
    for (int row = 0; row < tile.height; ++row) {
        const bool sampled =
            cluster_row >= 0 && (tile.row0 + row) % cluster_row_stride == cluster_row;
        for (int i = row * tile.width; i < (row + 1) * tile.width; ++i) {
            const Fragment* f = tile.fragments.data() + tile.first[i];
            const Fragment* const end = tile.fragments.data() + tile.first[i + 1];
            if (f == end) continue;
            const auto tell_clusters = [&](std::uint32_t a, const FixedRadiance& by_a,
                                           std::uint32_t b, const FixedRadiance& by_b) {
                transfer[cluster[a] * n + cluster[b]] += shifted(by_b);
                transfer[cluster[b] * n + cluster[a]] += shifted(by_a);
            };
            // The first and the last of a list face the environment.
            fetch_ahead(f);
            const std::uint32_t first = lower_slot(*f);
            received[first] += along;
            entered += along;
            escaped += radiance[first];
            if (sampled) tell_clusters(outside, along, first, radiance[first]);
            std::uint32_t behind = upper_slot(*f);
            for (++f; f != end; ++f) {
                fetch_ahead(f);
                const std::uint32_t ahead = lower_slot(*f);
                received[ahead] += radiance[behind];
                received[behind] += radiance[ahead];
                if (sampled) tell_clusters(ahead, radiance[ahead], behind, radiance[behind]);
                behind = upper_slot(*f);
            }
            received[behind] += against;
            entered += against;
            escaped += radiance[behind];
            if (sampled) tell_clusters(behind, radiance[behind], outside, against);
        }
    }
    received[outside] += escaped;
    tally.entered += entered;
    tally.fragments += tile.fragments.size();
}

void Exchange::transfer(TransilluminationBuffer& buffer, const Bundle& bundle) {
    const int cluster_row = cluster_count_ > 0 ? bundle.random_row % cluster_row_stride : -1;
    buffer.trace(bundle, workers_, [&](const TileLists& tile, int worker) {
        exchange_tile(tile, cluster_row, tallies_[worker]);
    });
}

void Exchange::transfer(TransilluminationBuffer& buffer, const Bundle& bundle,
                        MonteCarloComponent& residual) {
    const int cluster_row = cluster_count_ > 0 ? bundle.random_row % cluster_row_stride : -1;
    residual.begin(bundle);
    buffer.trace(bundle, workers_, [&](const TileLists& tile, int worker) {
        residual.exchange_tile(tile, buffer, tables(), cluster_row, tallies_[worker], worker);
    });
    residual.end(buffer, tables());
}

std::uint64_t Exchange::fragments() const {
    std::uint64_t sum = 0;
    for (const ExchangeTally& p : tallies_) sum += p.fragments;
    return sum;
}

void Exchange::collect(ClusterTransfer& sum) {
    const std::uint32_t n = cluster_count_ + 1;
    for (std::uint32_t receiver = 0; receiver < n; ++receiver)
        for (std::uint32_t sender = 0; sender < n; ++sender) {
            FixedRadiance total;
            for (ExchangeTally& p : tallies_) {
                FixedRadiance& entry = p.transfer[receiver * n + sender];
                total += entry;
                entry = {};
            }
            const Received r = in_units(total, std::ldexp(unit_, cluster_shift));
            sum.at(receiver, sender).radiance += r.radiance;
            sum.at(receiver, sender).coverage += r.coverage;
        }
}

}  // namespace transillum
