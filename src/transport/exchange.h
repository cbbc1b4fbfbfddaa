/// Exchange of radiance between facing neighbours of the transillumination buffer (paper §3, both
/// ways).
///
/// Radiance travels as fixed-point integers, scaled by a power of two, so that sums are exact and
/// do not depend on the order or the thread in which fragments come; and scaling every source by
/// two changes no bit.
#pragma once

#include "transport/clusters.h"

#include <transillum/base/parallel.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <cstdint>
#include <vector>

namespace transillum {

/// Red, green, blue and a count of one, so that a sum carries its coverage along. Half a cache
/// line.
struct alignas(32) FixedRadiance {
    using Lanes = std::int64_t __attribute__((vector_size(32)));
    Lanes lane{};
    FixedRadiance& operator+=(const FixedRadiance& other) {
        lane += other.lane;
        return *this;
    }
};

/// Sum of received radiance and number of fragments.
struct Received {
    SpectrumSum radiance{0.0};
    double coverage = 0.0;
};

/// What clusters send each other, in units of radiance times fragments. Senders and receivers are
/// numbered as in Clusters; number `count` is everything outside the scene.
struct ClusterTransfer {
    explicit ClusterTransfer(std::uint32_t cluster_count)
        : count(cluster_count), entries(std::size_t{cluster_count + 1} * (cluster_count + 1)) {}
    ClusterTransfer& operator+=(const ClusterTransfer& other) {
        for (std::size_t i = 0; i < entries.size(); ++i) {
            entries[i].radiance += other.entries[i].radiance;
            entries[i].coverage += other.entries[i].coverage;
        }
        return *this;
    }
    std::uint32_t count;
    std::vector<Received> entries;
    [[nodiscard]] Received& at(std::uint32_t receiver, std::uint32_t sender) {
        return entries[std::size_t{receiver} * (count + 1) + sender];
    }
    [[nodiscard]] const Received& at(std::uint32_t receiver, std::uint32_t sender) const {
        return entries[std::size_t{receiver} * (count + 1) + sender];
    }
};

/// Both sides of a leaf share a cache line: the front at odd numbers, the back at even ones.
[[nodiscard]] inline std::uint32_t slot_of_patch(std::uint32_t patch, std::uint32_t leaf_count) {
    return patch < leaf_count ? 2 * patch + 1 : 2 * (patch - leaf_count);
}

/// What all patches send along a bundle, by slot.
struct ExchangeTables {
    std::uint32_t leaf_count = 0, cluster_count = 0;
    const FixedRadiance* radiance = nullptr;
    const std::uint8_t* cluster = nullptr;  ///< one a slot, then what is outside
    FixedRadiance along, against;           ///< of the environment
    double unit = 1.0;                      ///< radiance of one fixed-point step

    [[nodiscard]] Spectrum in_units(const FixedRadiance& r) const {
        return Spectrum(SpectrumSum(r.lane[0], r.lane[1], r.lane[2]) * unit);
    }
};

/// What one worker has seen arrive.
struct ExchangeTally {
    std::vector<FixedRadiance> received;  ///< one a slot, then what is outside
    std::vector<FixedRadiance> transfer;  ///< between clusters, receiver by receiver
    FixedRadiance entered;
    std::uint64_t fragments = 0;
};

class MonteCarloComponent;

class Exchange {
public:
    Exchange(std::uint32_t leaf_count, const Clusters& clusters, const Workers& workers);

    /// Radiance that every patch sends from now on. \param largest that any patch may send until
    /// the next call; \param most_fragments that a patch may receive until then.
    /// Rounded to steps at random, so that the mean over patches and draws keeps what is far below
    /// the largest.
    void set_radiance(const std::vector<Spectrum>& radiance, float largest, double most_fragments);
    /// Number of the draw that rounds from the next time on: of directions so far, say.
    void set_draw(std::uint64_t draw) { draw_ = draw; }
    /// The same for one patch, as for sides that send different radiance along each bundle. Above
    /// the largest it is cut off. Different patches may be set at once.
    void set_radiance(std::uint32_t patch, const Spectrum& radiance);
    /// What comes from outside: along the direction, and against it.
    void set_environment(const Spectrum& along, const Spectrum& against);

    /// Transfers the radiance of all patches along one bundle, both ways.
    void transfer(TransilluminationBuffer& buffer, const Bundle& bundle);
    /// The same with the Monte-Carlo component beside it. \pre the buffer is made of its cells
    void transfer(TransilluminationBuffer& buffer, const Bundle& bundle,
                  MonteCarloComponent& residual);

    /// Takes out what arrived at a patch since it was last taken; patch 2 * leaf_count is
    /// everything outside. Different patches may be taken at once.
    [[nodiscard]] Received take(std::uint32_t patch) {
        const std::uint32_t slot = slot_of(patch);
        FixedRadiance sum;
        for (ExchangeTally& p : tallies_) {
            sum += p.received[slot];
            p.received[slot] = {};
        }
        return in_units(sum, unit_);
    }
    /// Takes out what came in from outside since it was last taken.
    [[nodiscard]] Received take_entered();
    /// Adds what clusters sent each other since the last call.
    void collect(ClusterTransfer& sum);

    /// Exchanged so far.
    [[nodiscard]] std::uint64_t fragments() const;

    /// In steps, cut off where `largest` would be exceeded.
    [[nodiscard]] FixedRadiance fixed(const Spectrum& radiance) const;
    /// The largest radiance is below 2^bits steps.
    [[nodiscard]] int bits() const { return bits_; }
    [[nodiscard]] ExchangeTables tables() const {
        return {leaf_count_, cluster_count_, radiance_.data(), cluster_.data(), along_,
                against_,    unit_};
    }

private:
    [[nodiscard]] FixedRadiance rounded_at_random(const Spectrum& radiance, double draw) const;
    [[nodiscard]] std::uint32_t slot_of(std::uint32_t patch) const {
        return patch == 2 * leaf_count_ ? patch : slot_of_patch(patch, leaf_count_);
    }
    void exchange_tile(const TileLists& tile, int cluster_row, ExchangeTally& tally) const;

    static Received in_units(const FixedRadiance& sum, double unit) {
        return {SpectrumSum(sum.lane[0], sum.lane[1], sum.lane[2]) * unit,
                static_cast<double>(sum.lane[3])};
    }

    std::uint32_t leaf_count_, cluster_count_;
    const Workers& workers_;
    double unit_ = 1.0;  ///< radiance of one fixed-point step
    double most_steps_ = 0.0;
    int bits_ = 0;  ///< of them
    std::uint64_t draw_ = 0;
    std::vector<FixedRadiance> radiance_;  ///< one a slot
    FixedRadiance along_, against_;        ///< of the environment
    std::vector<std::uint8_t> cluster_;    ///< one a slot, then what is outside
    std::vector<ExchangeTally> tallies_;   ///< one a worker
};

}  // namespace transillum
