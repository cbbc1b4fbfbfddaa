#include "transport/running_average.h"

#include "transport/energy_balance.h"

#include <bit>
#include <cmath>
#include <utility>

namespace transillum {

namespace {

/// Up to here every phase starts its average anew: what was summed came from too early an estimate.
/// After one at 32, an even room was still off by 8e-6 at 256 directions, now 2e-6.
constexpr std::uint64_t last_restart = 64;
/// From here on moves of the average tell its error.
constexpr std::uint64_t first_compared = 32;

std::vector<double> areas_of_leaves(const SurfaceMesh& mesh, const PatchHierarchy& patches) {
    std::vector<double> areas;
    areas.reserve(patches.leaf_count);
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf)
        areas.push_back(area_of_leaf(mesh, patches, leaf));
    return areas;
}

void take_over(const ClusterTransfer& from, double scale, ClusterTransfer& to) {
    if (from.count == to.count) to = from;
    for (Received& r : to.entries) {
        r.radiance *= scale;
        r.coverage *= scale;
    }
}

}  // namespace

RunningAverage::RunningAverage(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                               const PatchSources& sources, Averaging averaging,
                               const Workers& workers)
    : averaging_(averaging),
      workers_(workers),
      clusters_(averaging == Averaging::balanced ? make_clusters(mesh, patches) : Clusters{}),
      between_clusters_(clusters_.count),
      earlier_between_clusters_(clusters_.count),
      elements_(mesh, patches, sources, workers),
      leaf_area_(areas_of_leaves(mesh, patches)),
      error_(leaf_area_, workers) {
    limit();
}

void RunningAverage::go_on_from(const IterationSums& sums, const PatchHierarchy& patches,
                                const GlossySides& glossy, double pixel_size, bool are_same) {
    elements_.set_sums(inherited(sums, sums.elements, patches, glossy, pixel_size),
                       inherited(sums, sums.earlier, patches, glossy, pixel_size));
    const double scale = std::pow(sums.pixel_size / pixel_size, 2.0);
    take_over(sums.between_clusters, scale, between_clusters_);
    take_over(sums.earlier_between_clusters, scale, earlier_between_clusters_);
    done_ = sums.directions;
    restarted_at_ = sums.restarted_at;
    error_.set_history(sums.error);
    brightest_ = sums.brightest_environment;
    limit();
    if (!are_same) return error_.begin_anew(elements_);
    relative_error_ = sums.relative_error;
    begins_anew_ = sums.restarts;
}

void RunningAverage::keep(IterationSums& sums) const {
    sums.averaging = averaging_;
    sums.directions = done_;
    sums.restarted_at = restarted_at_;
    sums.elements = elements_.sums();
    sums.earlier = elements_.earlier_sums();
    sums.between_clusters = between_clusters_;
    sums.earlier_between_clusters = earlier_between_clusters_;
    sums.error = error_.history();
    sums.relative_error = relative_error_;
    sums.restarts = begins_anew_;
    sums.brightest_environment = brightest_;
}

/// In proportion to the root of a direction's number: later ones brought better estimates, but a
/// low-discrepancy sequence does best where all count alike. The paper's: 1/m.
double RunningAverage::weight_after(std::uint64_t directions) const {
    return averaging_ == Averaging::balanced ? std::sqrt(static_cast<double>(done_ + directions))
                                             : 1.0;
}

void RunningAverage::meet_environment(float brightest) {
    if (brightest <= brightest_) return;
    brightest_ = brightest;
    limit();
}

void RunningAverage::begin_block() {
    if (!balances_at(done_) || restarted_at_ == done_ || (done_ > last_restart && !begins_anew_))
        return;
    if (begins_anew_) error_.begin_anew(elements_);
    begins_anew_ = false;
    restarted_at_ = done_;
    elements_.restart();
    error_.restart();
    earlier_between_clusters_ = std::move(between_clusters_);
    between_clusters_ = ClusterTransfer(clusters_.count);
}

void RunningAverage::end_block(Exchange& exchange, std::uint64_t directions, bool is_even,
                               ResidualEffect* effect) {
    elements_.average_in(exchange, directions, weight_after(directions), effect);
    error_.add(done_, done_ + directions, weight_after(directions));
    done_ += directions;
    if (averaging_ == Averaging::balanced) exchange.collect(between_clusters_);
    if (balances_at(done_)) balance();
    if (done_ >= 2 * restarted_at_) forget();
    if (done_ < first_compared) return;
    if (std::has_single_bit(done_)) error_.compare(elements_);
    if (is_even) estimate_relative_error();
}

/// Within the phase after a restart there is too little to do without what came before; and between
/// powers of two the last directions are not in balance yet. But transfers from before the first
/// balance were of light that had only begun to spread.
void RunningAverage::conclude() {
    if (balances_at(done_)) return;
    recall();
    if (averaging_ == Averaging::balanced && done_ > 2 * first_balance) balance();
}

bool RunningAverage::balances_at(std::uint64_t done) const {
    return averaging_ == Averaging::balanced && done >= first_balance && std::has_single_bit(done);
}

void RunningAverage::balance() {
    balance_energy(elements_, clusters_, between_clusters_,
                   done_ == first_balance ? BalanceShape::flat : BalanceShape::kept, brightest_,
                   workers_);
    if (done_ == first_balance) elements_.forget_error();
}

/// Of averages that are nothing but samples, a limit would change the mean.
void RunningAverage::limit() {
    if (averaging_ == Averaging::balanced)
        elements_.limit_incoming(largest_incoming(elements_, brightest_, workers_));
}

void RunningAverage::recall() {
    elements_.recall();
    error_.recall();
    between_clusters_ += earlier_between_clusters_;
}

void RunningAverage::forget() {
    elements_.forget();
    error_.forget();
    earlier_between_clusters_ = ClusterTransfer(clusters_.count);
}

}  // namespace transillum
