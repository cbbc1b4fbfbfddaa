#include "transport/bundle_transfer.h"

#include <algorithm>

namespace transillum {

namespace {

/// A residual is cut off above so many times what any patch sends: its peaks take bits from all
/// else.
constexpr float most_headroom = 64.0f;
/// From so many leaves on, quarters of all of them cost more than a whole buffer. The paper has it
/// at 100 000 (§3.1.2); with 241 195 leaves and 1000 pixels it was 58 against 154 ms a direction.
constexpr std::uint32_t most_leaves_for_subpatch = 600'000;

}  // namespace

MonteCarlo representation_of(MonteCarlo monte_carlo, const PatchHierarchy& patches) {
    if (monte_carlo != MonteCarlo::automatic) return monte_carlo;
    return patches.leaf_count < most_leaves_for_subpatch ? MonteCarlo::subpatch
                                                         : MonteCarlo::wavefront;
}

std::uint64_t monte_carlo_bytes(MonteCarlo monte_carlo, const SurfaceMesh& mesh,
                                const PatchHierarchy& patches, double pixel_size, int threads) {
    const auto workers = static_cast<std::uint64_t>(threads);
    const std::uint64_t of_patches = patches.patch_count() * std::uint64_t{64};
    switch (representation_of(monte_carlo, patches)) {
        case MonteCarlo::subpatch:
            return of_patches + 4 * std::uint64_t{patches.patch_count()} * (48 + 32 * workers);
        case MonteCarlo::wavefront: {
            // A direction sees half of the area, on average; two buffers of points, with room.
            double area = 0.0;
            for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r) area += area_of(mesh, r);
            const double points = 0.5 * area / (pixel_size * pixel_size);
            return of_patches + patches.patch_count() * 64 * workers +
                   static_cast<std::uint64_t>(2.0 * 1.5 * 32.0 * points);
        }
        default:
            return 0;
    }
}

BundleTransfer::BundleTransfer(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                               double pixel_size, std::uint64_t seed, const Workers& workers)
    : mesh_(mesh),
      patches_(patches),
      workers_(workers),
      order_(seed),
      seed_(seed),
      buffer_(std::make_unique<TransilluminationBuffer>(mesh, patches, pixel_size)) {}

Bundle BundleTransfer::bundle(std::uint64_t i) {
    return sample_bundle(static_cast<std::uint32_t>(order_.at(i)), seed_);
}

void BundleTransfer::make_buffer(const PatchHierarchy& cells) {
    seconds_ += buffer_->seconds();
    buffer_ = std::make_unique<TransilluminationBuffer>(mesh_, cells, pixel_size());
}

void BundleTransfer::represent(MonteCarlo representation, Carried carried) {
    residual_ = representation == MonteCarlo::subpatch
                    ? make_subpatch_component(patches_, carried, workers_)
                    : make_wavefront_component(mesh_, patches_, carried, workers_);
    make_buffer(residual_->cells());
}

void BundleTransfer::carry(MonteCarlo representation, Carried carried,
                           const FiniteElementComponent& elements, std::uint64_t next) {
    represent(representation, carried);
    reflections_.assign(patches_.patch_count(), {});
    headroom_ = carried == Carried::everything
                    ? most_headroom
                    : std::min(most_headroom, 1.0f + elements.largest_gain());
    order_.shuffle(next);
}

void BundleTransfer::carry_no_more(std::uint64_t next) {
    norms_.resize(patches_.patch_count());
    for (std::uint32_t slot = 0; slot < norms_.size(); ++slot)
        norms_[slot] = residual_->norms(slot);
    make_buffer(patches_);
    residual_.reset();
    reflections_ = {};
    headroom_ = 1.0f;
    order_.unshuffle(next);
}

void BundleTransfer::record(MonteCarlo representation) {
    represent(representation, Carried::nothing);
    records_ = true;
}

void BundleTransfer::transfer(Exchange& exchange, const FiniteElementComponent& elements,
                              const Bundle& bundle) {
    if (!residual_) return exchange.transfer(*buffer_, bundle);
    if (!records_) {
        if (carried_ > 0) elements.reflect_residual(last_, bundle, *residual_, reflections_);
        residual_->reflect(reflections_, exchange);
        last_ = bundle;
        ++carried_;
    }
    exchange.transfer(*buffer_, bundle, *residual_);
}

ResidualNorms BundleTransfer::norms(std::uint32_t patch) const {
    const std::uint32_t slot = slot_of_patch(patch, patches_.leaf_count);
    return residual_ ? residual_->norms(slot) : norms_[slot];
}

}  // namespace transillum
