#include "transport/exchange.h"

#include <algorithm>
#include <cmath>

namespace transillum {

namespace {

/// Every fourth row of pixels, from a random one, suffices for the few numbers that clusters exchange.
constexpr int cluster_row_stride = 4;
/// Cluster sums collect far more fragments than a patch does: they drop this many low bits.
constexpr int cluster_shift = 8;

FixedRadiance shifted(const FixedRadiance& r) {
    return {FixedRadiance::Lanes{r.lane[0] >> cluster_shift, r.lane[1] >> cluster_shift, r.lane[2] >> cluster_shift, r.lane[3]}};
}

Received in_units(const FixedRadiance& sum, double unit) {
    return {SpectrumSum(sum.lane[0], sum.lane[1], sum.lane[2]) * unit, static_cast<double>(sum.lane[3])};
}

}  // namespace

Exchange::Exchange(std::uint32_t leaf_count, const Clusters& clusters, const Workers& workers)
    : leaf_count_(leaf_count), clusters_(clusters), workers_(workers), radiance_(2 * std::size_t{leaf_count} + 1), partials_(workers.count()) {
    for (Partial& p : partials_) {
        p.received.resize(radiance_.size());
        p.transfer.resize(std::size_t{clusters.count + 1} * (clusters.count + 1));
    }
    radiance_.back().lane = FixedRadiance::Lanes{0, 0, 0, 1};  // the environment is dark, and is seen
}

void Exchange::set_radiance(const std::vector<Spectrum>& radiance, double most_fragments) {
    float largest = 0.0f;
    for (const Spectrum& r : radiance) largest = std::max(largest, max_channel(r));
    // largest < 2^exponent; a sum of most_fragments of them stays below 2^62.
    int exponent = 0;
    std::frexp(largest, &exponent);
    const int bits = std::min(40, 62 - static_cast<int>(std::ceil(std::log2(most_fragments))));
    unit_ = largest > 0.0f ? std::ldexp(1.0, exponent - bits) : 1.0;
    const double scale = 1.0 / unit_;
    workers_.for_ranges(radiance.size(), 16384, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto fixed = [&](float x) { return std::llrint(x * scale); };
            radiance_[i].lane = FixedRadiance::Lanes{fixed(radiance[i].x), fixed(radiance[i].y), fixed(radiance[i].z), 1};
        }
    });
}

void Exchange::exchange_tile(const TileLists& tile, int cluster_row, Partial& partial) const {
    const std::uint32_t outside = 2 * leaf_count_;
    FixedRadiance* const received = partial.received.data();
    const FixedRadiance* const radiance = radiance_.data();
    const std::uint8_t* const cluster = clusters_.of_patch.data();
    const std::uint32_t n = clusters_.count + 1;
    FixedRadiance escaped;
    for (int row = 0; row < tile.height; ++row) {
        const bool sampled = cluster_row >= 0 && (tile.row0 + row) % cluster_row_stride == cluster_row;
        for (int i = row * tile.width; i < (row + 1) * tile.width; ++i) {
            const Fragment* f = tile.fragments.data() + tile.first[i];
            const Fragment* const end = tile.fragments.data() + tile.first[i + 1];
            if (f == end) continue;
            const auto tell_clusters = [&](std::uint32_t a, std::uint32_t b) {
                partial.transfer[cluster[a] * n + cluster[b]] += shifted(radiance[b]);
                partial.transfer[cluster[b] * n + cluster[a]] += shifted(radiance[a]);
            };
            // The first and the last of a list face the environment.
            const std::uint32_t first = lower_patch(*f, leaf_count_);
            received[first] += radiance[outside];
            escaped += radiance[first];
            if (sampled) tell_clusters(outside, first);
            std::uint32_t behind = upper_patch(*f, leaf_count_);
            for (++f; f != end; ++f) {
                const std::uint32_t ahead = lower_patch(*f, leaf_count_);
                received[ahead] += radiance[behind];
                received[behind] += radiance[ahead];
                if (sampled) tell_clusters(ahead, behind);
                behind = upper_patch(*f, leaf_count_);
            }
            received[behind] += radiance[outside];
            escaped += radiance[behind];
            if (sampled) tell_clusters(behind, outside);
        }
    }
    received[outside] += escaped;
    partial.fragments += tile.fragments.size();
}

void Exchange::transfer(TransilluminationBuffer& buffer, const Bundle& bundle) {
    const int cluster_row = clusters_.count > 0 ? bundle.random_row % cluster_row_stride : -1;
    buffer.trace(bundle, workers_, [&](const TileLists& tile, int worker) {
        exchange_tile(tile, cluster_row, partials_[worker]);
    });
}

void Exchange::collect(const std::function<void(std::uint32_t, const Received&)>& take) {
    workers_.for_ranges(radiance_.size(), 16384, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t patch = begin; patch < end; ++patch) {
            FixedRadiance sum;
            for (Partial& p : partials_) {
                sum += p.received[patch];
                p.received[patch] = {};
            }
            take(static_cast<std::uint32_t>(patch), in_units(sum, unit_));
        }
    });
    for (Partial& p : partials_) {
        fragments_ += p.fragments;
        p.fragments = 0;
    }
}

void Exchange::collect(ClusterTransfer& sum) {
    const std::uint32_t n = clusters_.count + 1;
    for (std::uint32_t receiver = 0; receiver < n; ++receiver)
        for (std::uint32_t sender = 0; sender < clusters_.count; ++sender) {
            FixedRadiance total;
            for (Partial& p : partials_) {
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
