#include "transport/monte_carlo_component.h"
#include "transport/residual_exchange.h"

#include <transillum/geometry/split_leaves.h>

#include <array>
#include <utility>

namespace transillum {

namespace {

constexpr std::size_t grain = 4096;
constexpr int quarters = 4;

using Lanes = BundleReflection::Lanes;

double luminance_of(const Lanes& l) {
    return luminance(SpectrumSum(l[0], l[1], l[2]));
}

class SubpatchComponent final : public MonteCarloComponent {
public:
    SubpatchComponent(const PatchHierarchy& patches, Carried carried, const Workers& workers)
        : MonteCarloComponent(patches.leaf_count, carried),
          split_(split_all_leaves(patches)),
          workers_(workers),
          children_(patches.leaf_count),
          residual_(2 * std::size_t{split_.patches.leaf_count}),
          mean_(residual_.size()),
          received_(workers.count(), std::vector<FixedRadiance>(residual_.size())) {
        std::vector<std::uint8_t> found(patches.leaf_count);
        for (std::uint32_t child = 0; child < split_.patches.leaf_count; ++child) {
            const std::uint32_t parent = split_.parent[child];
            children_[parent][found[parent]++] = child;
        }
    }

    [[nodiscard]] const PatchHierarchy& cells() const override { return split_.patches; }

    void reflect(std::span<const BundleReflection> reflections, const Exchange& exchange) override {
        workers_.for_ranges(arrived_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t slot = begin; slot < end; ++slot)
                reflect_slot(static_cast<std::uint32_t>(slot), reflections[slot], exchange);
        });
        ++directions_;
    }

    void begin(const Bundle&) override {}

    void exchange_tile(const TileLists& tile, const TransilluminationBuffer&,
                       const ExchangeTables& tables, int cluster_row, ExchangeTally& tally,
                       int worker) override {
        struct Layer {
            const std::uint32_t* parent;
            const FixedRadiance* residual;
            FixedRadiance* received;
            const Fragment* fragments;
            [[nodiscard]] ResidualPoint point(Fragment f, std::uint32_t, int, int) const {
                const std::uint32_t upper = upper_slot(f);
                const std::uint32_t patch = 2 * parent[leaf_of(f)] + (upper & 1u);
                return {patch ^ 1u, patch, residual[upper ^ 1u], residual[upper]};
            }
            void arrive_at_lower(const ResidualPoint&, std::uint32_t i,
                                 const FixedRadiance& r) const {
                received[lower_slot(fragments[i])] += r;
            }
            void arrive_at_upper(const ResidualPoint&, std::uint32_t i,
                                 const FixedRadiance& r) const {
                received[upper_slot(fragments[i])] += r;
            }
        } layer{split_.parent.data(), residual_.data(), received_[worker].data(),
                tile.fragments.data()};
        exchange_with_residual(tile, tables, cluster_row, carried_, tally, layer);
    }

    void end(const TransilluminationBuffer&, const ExchangeTables& tables) override {
        workers_.for_ranges(arrived_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t slot = begin; slot < end; ++slot)
                arrived_[slot] = take(static_cast<std::uint32_t>(slot), tables);
        });
    }

    [[nodiscard]] Spectrum incoming(const SurfaceSide& p) const override {
        const std::uint32_t cell = split_.patches.leaf_at(p.root, p.b1, p.b2);
        return incoming_of_cell(p.back ? cell + split_.patches.leaf_count : cell);
    }

    [[nodiscard]] Spectrum incoming_of_cell(std::uint32_t cell_patch) const override {
        const std::uint32_t slot = slot_of_patch(cell_patch, split_.patches.leaf_count);
        const Lanes& mean = mean_[slot];
        if (mean[3] > 0.0f) return {mean[0], mean[1], mean[2]};
        return arrived_[2 * split_.parent[slot / 2] + slot % 2].radiance;
    }

private:
    [[nodiscard]] std::array<std::uint32_t, quarters> cell_slots(std::uint32_t slot) const {
        std::array<std::uint32_t, quarters> slots = children_[slot / 2];
        for (std::uint32_t& s : slots) s = 2 * s + slot % 2;
        return slots;
    }

    Arrived take(std::uint32_t slot, const ExchangeTables& tables) {
        FixedRadiance all;
        for (const std::uint32_t cell : cell_slots(slot)) {
            FixedRadiance sum;
            for (auto& received : received_) sum += std::exchange(received[cell], {});
            all += sum;
            mean_[cell] = mean_of(sum, tables);
        }
        const Lanes mean = mean_of(all, tables);
        return {{mean[0], mean[1], mean[2]}, mean[3]};
    }

    /// With the count as fourth lane.
    static Lanes mean_of(const FixedRadiance& sum, const ExchangeTables& tables) {
        const auto count = static_cast<float>(sum.lane[3]);
        if (sum.lane[3] == 0) return Lanes{};
        Lanes mean = lanes_of(tables.in_units(sum) / count);
        mean[3] = count;
        return mean;
    }

    void reflect_slot(std::uint32_t slot, const BundleReflection& r, const Exchange& exchange) {
        const Arrived& all = arrived_[slot];
        const Lanes mean = r.gain * lanes_of(all.radiance) - r.projection;
        double spread = 0.0;
        for (const std::uint32_t cell : cell_slots(slot)) {
            // Of a quarter between pixels' centres the patch's mean is as good as anything.
            const bool seen = mean_[cell][3] > 0.0f;
            const Lanes sent = seen ? r.gain * mean_[cell] - r.projection : mean;
            residual_[cell] = exchange.fixed({sent[0], sent[1], sent[2]});
            if (!seen) continue;
            const double deviation = luminance_of(sent - mean);
            spread += mean_[cell][3] * deviation * deviation;
        }
        if (!(all.coverage > 0.0f)) return;
        norms_[slot].spatial += spread / all.coverage;
        const double shift = luminance_of(mean);
        norms_[slot].directional += shift * shift;
    }

    SplitPatches split_;
    const Workers& workers_;
    std::vector<std::array<std::uint32_t, quarters>> children_;  ///< one a leaf
    // One a slot of a cell.
    std::vector<FixedRadiance> residual_;               ///< to be sent
    std::vector<Lanes> mean_;                           ///< of what arrived, and its coverage
    std::vector<std::vector<FixedRadiance>> received_;  ///< one a worker, along this bundle
};

}  // namespace

std::unique_ptr<MonteCarloComponent> make_subpatch_component(const PatchHierarchy& patches,
                                                             Carried carried,
                                                             const Workers& workers) {
    return std::make_unique<SubpatchComponent>(patches, carried, workers);
}

}  // namespace transillum
