#include "transport/carrying.h"

#include <algorithm>
#include <span>

namespace transillum {

namespace {

/// Share of what patches receive below which rounding makes a difference, too.
constexpr double least_effect = 1e-6;

/// The component is carried from here on: earlier, elements are mostly noise. Where that is
/// automatic, the same number of directions again tells whether it is worth it.
constexpr std::uint64_t first_carried = 128;

/// Squares of radiances may be more than floats hold.
float saturated(double x) {
    return static_cast<float>(std::min(x, double{std::numeric_limits<float>::max()}));
}

double mean_incoming(const FiniteElementComponent& elements, const PatchHierarchy& patches,
                     std::span<const double> leaf_area) {
    double mean = 0.0, area = 0.0;
    for (std::uint32_t p = 0; p < elements.patch_count(); ++p) {
        if (elements.coverage(p) == 0.0) continue;
        const double a = leaf_area[patches.leaf_of_patch(p)];
        area += a;
        mean += a * luminance(elements.incoming(p));
    }
    return area > 0.0 ? mean / area : 0.0;
}

}  // namespace

void Carrying::go_on_from(const CarriedBefore& before) {
    before_ = before;
    if (!before.given_up) return;
    representation_ = before.representation;
    residual_effect_ = before.effect;
    transfer_.set_shuffled({before.shuffled_from, before.shuffled_until});
}

CarriedBefore Carrying::kept(std::uint64_t in_block) const {
    const auto [from, until] = transfer_.shuffled();
    const bool given_up = representation_ != MonteCarlo::off && !transfer_.residual();
    return {representation_,
            directions() - (transfer_.residual() ? in_block : 0),
            from,
            until,
            given_up,
            residual_effect_};
}

void Carrying::begin_block() {
    if (representation_ == MonteCarlo::off && first_direction() <= average_.directions()) begin();
}

void Carrying::add_direction() {
    if (effect_) effect_->add(*transfer_.residual(), workers_);
}

void Carrying::end_block() {
    const std::uint64_t done = average_.directions();
    if (effect_ && done >= effect_begin_ + first_carried / 2) effect_->begin_second_half();
    if (effect_ && done >= effect_begin_ + first_carried) decide();
}

std::uint64_t Carrying::longest_block() const {
    return effect_ ? first_carried / 2 : std::numeric_limits<std::uint64_t>::max();
}

std::uint64_t Carrying::first_direction() const {
    if (options_.averaging == Averaging::none) return 0;
    if (options_.monte_carlo == MonteCarlo::off) return std::numeric_limits<std::uint64_t>::max();
    return options_.averaging == Averaging::paper ? 0 : first_carried;
}

void Carrying::begin() {
    const std::uint64_t done = average_.directions();
    const bool all = options_.averaging == Averaging::none;
    // What elements alone brought is another, coarser estimate.
    average_.set_begins_anew(options_.monte_carlo != MonteCarlo::automatic && !options_.start);
    representation_ = carried_by(options_.monte_carlo, options_.averaging);
    if (representation_ == MonteCarlo::automatic) {
        representation_ = representation_of(representation_, patches_);
        effect_.emplace(patches_.leaf_count);
        effect_begin_ = done;
    }
    transfer_.carry(representation_, all ? Carried::everything : Carried::residual,
                    average_.elements(), done);
    if (before_.directions > 0) {
        transfer_.set_shuffled({before_.shuffled_from, before_.shuffled_until});
        anew_at_ = done;
    }
    if (all) average_.elements().leave_reflection_to_residual();
}

/// What changes less than the error that is to be expected is carried no more.
void Carrying::decide() {
    const std::uint64_t done = average_.directions();
    const double mean = mean_incoming(average_.elements(), patches_, average_.leaf_area());
    residual_effect_ = mean > 0.0 ? effect_->root_mean_square(average_.leaf_area()) / mean : 0.0;
    effect_.reset();
    const double expected = options_.target_error > 0.0
                                ? options_.target_error
                                : average_.relative_error() * static_cast<double>(done) /
                                      static_cast<double>(std::max(done, options_.iterations));
    if (residual_effect_ > std::max(expected, least_effect))
        average_.set_begins_anew(true);
    else
        transfer_.carry_no_more(done);
}

void Carrying::tell(TransportResult& result) const {
    result.monte_carlo = representation_;
    result.carried = directions();
    result.carried_anew_at = anew_at_;
    result.carried_to_the_end = transfer_.residual() != nullptr;
    result.residual_effect = residual_effect_;
    // Along the first direction nothing is carried yet.
    if (transfer_.carried() < 2) return;
    const double n = static_cast<double>(transfer_.carried()) - 1.0;
    for (std::uint32_t p = 0; p < patches_.patch_count(); ++p) {
        const ResidualNorms norms = transfer_.norms(p);
        result.spatial_error.push_back(saturated(norms.spatial / n));
        result.directional_error.push_back(saturated(norms.directional / n));
    }
}

}  // namespace transillum
