#include "transport/bundle_transfer.h"

#include <algorithm>

namespace transillum {

namespace {

/// A residual is cut off above so many times what any patch sends: its peaks take bits from all
/// else.
constexpr float most_headroom = 64.0f;

}  // namespace

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

void BundleTransfer::carry(MonteCarlo representation, const FiniteElementComponent& elements) {
    residual_ = representation == MonteCarlo::subpatch
                    ? make_subpatch_component(patches_, workers_)
                    : make_wavefront_component(mesh_, patches_, workers_);
    buffer_ = std::make_unique<TransilluminationBuffer>(mesh_, residual_->cells(), pixel_size());
    reflections_.assign(patches_.patch_count(), {});
    headroom_ = std::min(most_headroom, 1.0f + elements.largest_gain());
    order_.shuffle();
}

void BundleTransfer::carry_all() {
    residual_->reflect_all();
    headroom_ = most_headroom;
}

void BundleTransfer::carry_no_more() {
    norms_.resize(patches_.patch_count());
    for (std::uint32_t slot = 0; slot < norms_.size(); ++slot)
        norms_[slot] = residual_->norms(slot);
    buffer_ = std::make_unique<TransilluminationBuffer>(mesh_, patches_, pixel_size());
    residual_.reset();
    reflections_ = {};
    headroom_ = 1.0f;
    order_.unshuffle();
}

void BundleTransfer::transfer(Exchange& exchange, const FiniteElementComponent& elements,
                              const Bundle& bundle) {
    if (!residual_) return exchange.transfer(*buffer_, bundle);
    if (carried_ > 0) elements.reflect_residual(last_, bundle, *residual_, reflections_);
    residual_->reflect(reflections_, exchange);
    exchange.transfer(*buffer_, bundle, *residual_);
    last_ = bundle;
    ++carried_;
}

void BundleTransfer::transfer_alone(Exchange& exchange, const Bundle& bundle) {
    residual_->reflect(reflections_, exchange);
    exchange.transfer(*buffer_, bundle, *residual_);
}

ResidualNorms BundleTransfer::norms(std::uint32_t patch) const {
    const std::uint32_t slot = slot_of_patch(patch, patches_.leaf_count);
    return residual_ ? residual_->norms(slot) : norms_[slot];
}

}  // namespace transillum
