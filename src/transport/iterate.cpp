// The loop of paper §2.2:
//
//   L^r    = T*_fr (L^e + L~(m-1) + dL(m-1))  transfer, along one bundle and both ways
//   L~'(m) = projection of L^r                Exchange, per patch
//   dL(m)  = L^r - L~'(m)                     MonteCarloComponent, where it is carried
//   L~(m)  = average of the projections       FiniteElementComponent::average_in
//
// L~ is refreshed after blocks of directions, and balanced at powers of two (design 4.4).
#include <transillum/base/error.h>
#include <transillum/transport/iterate.h>

#include "transport/bundle_transfer.h"
#include "transport/clusters.h"
#include "transport/energy_balance.h"
#include "transport/exchange.h"
#include "transport/finite_elements.h"
#include "transport/iteration_sums.h"
#include "transport/relative_error.h"
#include "transport/residual_effect.h"

#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace transillum {

namespace {

constexpr std::uint64_t first_balance = 8;
/// Up to here every phase starts its average anew: what was summed came from too early an estimate.
/// After one at 32, an even room was still off by 8e-6 at 256 directions, now 2e-6.
constexpr std::uint64_t last_restart = 64;
/// The estimate is off by some 15 %, and runs tend to stop where it is low.
constexpr double margin_of_target = 1.25;
/// From here on moves of the average tell its error.
constexpr std::uint64_t first_compared = 32;
/// Longer blocks would leave the fixed-point sums too few bits.
constexpr std::uint64_t longest_block = 1024;

/// Share of what patches receive below which rounding makes a difference, too.
constexpr double least_effect = 1e-6;

/// The Monte-Carlo component is carried from here on: earlier, elements are mostly noise. Where
/// that is automatic, the same number of directions again tells whether it is worth it.
constexpr std::uint64_t first_carried = 128;

/// Directions until the estimate is refreshed: one at a time up to 8, then four blocks an octave.
std::uint64_t block_length(std::uint64_t done, Averaging averaging) {
    if (averaging == Averaging::paper || done < first_balance) return 1;
    return std::min(std::bit_floor(done) / 4, longest_block);
}

/// Squares of radiances may be more than floats hold.
float saturated(double x) {
    return static_cast<float>(std::min(x, double{std::numeric_limits<float>::max()}));
}

std::vector<double> areas_of_leaves(const SurfaceMesh& mesh, const PatchHierarchy& patches) {
    std::vector<double> areas;
    areas.reserve(patches.leaf_count);
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf)
        areas.push_back(area_of_leaf(mesh, patches, leaf));
    return areas;
}

class Iteration {
public:
    Iteration(const SurfaceMesh& mesh, const PatchHierarchy& patches, const PatchSources& sources,
              const IterationOptions& options, const Workers& workers, Monitor& monitor)
        : mesh_(mesh),
          patches_(patches),
          options_(options),
          workers_(workers),
          monitor_(monitor),
          transfer_(mesh, patches, options.pixel_size, options.seed, workers),
          clusters_(options.averaging == Averaging::balanced ? make_clusters(mesh, patches)
                                                             : Clusters{}),
          between_clusters_(clusters_.count),
          earlier_between_clusters_(clusters_.count),
          exchange_(patches.leaf_count, clusters_, workers),
          component_(mesh, patches, sources, workers),
          environment_(sources.environment),
          sides_(sources.glossy.sides),
          leaf_area_(areas_of_leaves(mesh, patches)),
          error_(leaf_area_, workers) {
        if (options.start) go_on_from(*options.start, sources.glossy);
    }

    TransportResult run() {
        while (done_ < options_.iterations && !stopped()) {
            begin_block();
            std::uint64_t block = block_length(done_, options_.averaging);
            if (effect_) block = std::min(block, first_carried / 2);
            const float brightest = brightest_environment(block);
            brightest_so_far_ = std::max(brightest_so_far_, brightest);
            component_.send(exchange_, brightest, most_fragments(block), transfer_.headroom());
            std::uint64_t in_block = 0;
            if (options_.keep_sums && block > 1) glossy_sums_ = component_.glossy_sums();
            do {
                transfer(transfer_.bundle(done_ + in_block), weight_after(block));
                ++in_block;
                monitor_.progress(
                    {"transport", done_ + in_block, options_.iterations, relative_error_});
            } while (in_block < block && done_ + in_block < options_.iterations && !stopped());
            // One that goes on begins the block that was cut short once more.
            if (in_block < block) keep_sums(std::move(glossy_sums_), in_block);
            end_block(in_block);
        }
        return finish();
    }

private:
    void transfer(const Bundle& bundle, double weight) {
        if (environment_.shines())
            exchange_.set_environment(environment_.radiance(-bundle.frame[2]),
                                      environment_.radiance(bundle.frame[2]));
        if (!sides_.empty()) component_.send_along(exchange_, bundle);
        transfer_.transfer(exchange_, component_, bundle);
        if (effect_) effect_->add(*transfer_.residual(), workers_);
        if (!sides_.empty()) component_.receive_along(exchange_, bundle, weight);
    }

    /// Weights in proportion to the root of a direction's number: later ones brought better
    /// estimates, but a low-discrepancy sequence does best where all count alike. The paper's: 1/m.
    double weight_after(std::uint64_t directions) const {
        return options_.averaging == Averaging::balanced
                   ? std::sqrt(static_cast<double>(done_ + directions))
                   : 1.0;
    }

    float brightest_environment(std::uint64_t block) {
        float brightest = 0.0f;
        for (std::uint64_t i = 0; environment_.shines() && i < block; ++i)
            for (const double way : {-1.0, 1.0})
                brightest = std::max(
                    brightest,
                    max_channel(environment_.radiance(way * transfer_.bundle(done_ + i).frame[2])));
        return brightest;
    }

    /// A patch is a planar triangle: it covers a pixel at most once a direction.
    double most_fragments(std::uint64_t block) const {
        const double diagonal_pixels =
            std::min(16384.0, scene_diagonal() / transfer_.pixel_size() + 4.0);
        // The environment is met twice a pixel.
        return 2.0 * diagonal_pixels * diagonal_pixels * static_cast<double>(block);
    }

    double scene_diagonal() const {
        glm::dvec3 low(mesh_.positions.front()), high(low);
        for (const glm::dvec3& p : mesh_.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        return glm::length(high - low);
    }

    void go_on_from(const IterationSums& sums, const GlossySides& glossy) {
        component_.set_sums(inherited(sums, sums.elements, patches_, glossy, options_.pixel_size),
                            inherited(sums, sums.earlier, patches_, glossy, options_.pixel_size));
        const double scale = std::pow(sums.pixel_size / options_.pixel_size, 2.0);
        take_over(sums.between_clusters, scale, between_clusters_);
        take_over(sums.earlier_between_clusters, scale, earlier_between_clusters_);
        done_ = sums.directions;
        restarted_at_ = sums.restarted_at;
        error_.set_history(sums.error);
        brightest_so_far_ = sums.brightest_environment;
        if (!is_of(sums, patches_, glossy, options_.pixel_size)) {
            error_.begin_anew(component_);
            return;
        }
        relative_error_ = sums.relative_error;
        restarts_ = sums.restarts;
        carried_before_ = sums.carried;
        if (!carried_before_.given_up) return;
        representation_ = carried_before_.representation;
        residual_effect_ = carried_before_.effect;
        transfer_.set_shuffled({carried_before_.shuffled_from, carried_before_.shuffled_until});
    }

    static void take_over(const ClusterTransfer& from, double scale, ClusterTransfer& to) {
        if (from.count == to.count) to = from;
        for (Received& r : to.entries) {
            r.radiance *= scale;
            r.coverage *= scale;
        }
    }

    void begin_block() {
        if (representation_ == MonteCarlo::off && carries_from() <= done_) begin_carrying();
        if (!balances_at(done_) || restarted_at_ == done_ || (done_ > last_restart && !restarts_))
            return;
        if (restarts_) error_.begin_anew(component_);
        restarts_ = false;
        restarted_at_ = done_;
        component_.restart();
        error_.restart();
        earlier_between_clusters_ = std::move(between_clusters_);
        between_clusters_ = ClusterTransfer(clusters_.count);
    }

    [[nodiscard]] std::uint64_t carries_from() const {
        if (options_.averaging == Averaging::none) return 0;
        if (options_.monte_carlo == MonteCarlo::off)
            return std::numeric_limits<std::uint64_t>::max();
        return options_.averaging == Averaging::paper ? 0 : first_carried;
    }

    void begin_carrying() {
        const bool all = options_.averaging == Averaging::none;
        // What elements alone brought is another, coarser estimate.
        restarts_ = options_.monte_carlo != MonteCarlo::automatic && !options_.start;
        representation_ = carried_by(options_.monte_carlo, options_.averaging);
        if (representation_ == MonteCarlo::automatic) {
            representation_ = representation_of(representation_, patches_);
            effect_.emplace(patches_.leaf_count);
            effect_begin_ = done_;
        }
        transfer_.carry(representation_, all ? Carried::everything : Carried::residual, component_,
                        done_);
        if (carried_before_.directions > 0) {
            transfer_.set_shuffled({carried_before_.shuffled_from, carried_before_.shuffled_until});
            carried_anew_at_ = done_;
        }
        if (all) component_.leave_reflection_to_residual();
    }

    /// What changes less than the error that is to be expected is carried no more.
    void decide_on_carrying() {
        const double mean = mean_incoming();
        residual_effect_ = mean > 0.0 ? effect_->root_mean_square(leaf_area_) / mean : 0.0;
        effect_.reset();
        const double expected = options_.target_error > 0.0
                                    ? options_.target_error
                                    : relative_error_ * static_cast<double>(done_) /
                                          static_cast<double>(std::max(done_, options_.iterations));
        if (!(residual_effect_ > std::max(expected, least_effect)))
            transfer_.carry_no_more(done_);
        else
            restarts_ = true;
    }

    double mean_incoming() const {
        double mean = 0.0, area = 0.0;
        for (std::uint32_t p = 0; p < component_.patch_count(); ++p) {
            if (component_.coverage(p) == 0.0) continue;
            const double a = leaf_area_[patches_.leaf_of_patch(p)];
            area += a;
            mean += a * luminance(component_.incoming(p));
        }
        return area > 0.0 ? mean / area : 0.0;
    }

    void end_block(std::uint64_t directions) {
        component_.average_in(exchange_, directions, weight_after(directions),
                              effect_ ? &*effect_ : nullptr);
        error_.add(done_, done_ + directions, weight_after(directions));
        done_ += directions;
        if (options_.averaging == Averaging::balanced) exchange_.collect(between_clusters_);
        if (balances_at(done_)) balance();
        if (done_ >= 2 * restarted_at_) forget();
        if (done_ >= first_compared) estimate_error();
        if (effect_ && done_ >= effect_begin_ + first_carried / 2) effect_->begin_second_half();
        if (effect_ && done_ >= effect_begin_ + first_carried) decide_on_carrying();
    }

    void estimate_error() {
        if (std::has_single_bit(done_)) error_.compare(component_);
        if (transfer_.is_even(done_)) relative_error_ = error_.relative_error(component_);
    }

    bool balances_at(std::uint64_t done) const {
        return options_.averaging == Averaging::balanced && done >= first_balance &&
               std::has_single_bit(done);
    }

    void recall() {
        component_.recall();
        error_.recall();
        between_clusters_ += earlier_between_clusters_;
    }

    void forget() {
        component_.forget();
        error_.forget();
        earlier_between_clusters_ = ClusterTransfer(clusters_.count);
    }

    void balance() {
        balance_energy(component_, clusters_, between_clusters_,
                       done_ == first_balance ? BalanceShape::flat : BalanceShape::kept,
                       brightest_so_far_, workers_);
        if (done_ == first_balance) component_.forget_error();
    }

    bool stopped() {
        if (monitor_.stop_requested()) return interrupted_ = true;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
        return (options_.seconds > 0.0 && elapsed.count() >= options_.seconds) ||
               (options_.target_error > 0.0 &&
                margin_of_target * relative_error_ <= options_.target_error);
    }

    /// As they were before this block, of which so many directions are done.
    void keep_sums(std::vector<GlossySum> glossy_sums, std::uint64_t in_block) {
        if (!options_.keep_sums) return;
        FiniteElementSums elements = component_.sums();
        if (!sides_.empty()) elements.glossy = std::move(glossy_sums);
        const auto [from, until] = transfer_.shuffled();
        const bool given_up = representation_ != MonteCarlo::off && !transfer_.residual();
        kept_ = std::make_shared<IterationSums>(
            IterationSums{patches_,
                          sides_,
                          transfer_.pixel_size(),
                          options_.averaging,
                          options_.monte_carlo,
                          done_,
                          restarted_at_,
                          std::move(elements),
                          component_.earlier_sums(),
                          between_clusters_,
                          earlier_between_clusters_,
                          {representation_, carried() - (transfer_.residual() ? in_block : 0), from,
                           until, given_up, residual_effect_},
                          error_.history(),
                          relative_error_,
                          restarts_,
                          brightest_so_far_});
    }

    [[nodiscard]] std::uint64_t carried() const {
        return carried_before_.directions + transfer_.carried();
    }

    TransportResult finish() {
        if (!kept_) keep_sums(component_.glossy_sums(), 0);
        // Within the phase after a restart there is too little to do without what came before; and
        // between powers of two the last directions are not in balance yet. But transfers from
        // before the first balance were of light that had only begun to spread.
        if (!balances_at(done_)) recall();
        if (options_.averaging == Averaging::balanced && done_ > 2 * first_balance &&
            !balances_at(done_))
            balance();
        TransportResult result;
        const std::uint32_t n = component_.patch_count();
        result.irradiance.resize(n);
        result.standard_error.resize(n);
        result.coverage.resize(n);
        const double correction = error_.correction(component_);
        for (std::uint32_t p = 0; p < n; ++p) {
            result.irradiance[p] = Spectrum(std::numbers::pi * component_.incoming(p));
            const SpectrumSum variance = correction * component_.incoming_variance(p);
            result.standard_error[p] = is_finite(variance)
                                           ? Spectrum(std::numbers::pi * glm::sqrt(variance))
                                           : result.irradiance[p];
            result.coverage[p] = static_cast<float>(component_.fragments(p));
        }
        result.iterations = done_;
        if (transfer_.is_even(done_)) relative_error_ = error_.relative_error(component_);
        result.relative_error = std::isfinite(relative_error_) ? relative_error_ : 1.0;
        result.interrupted = interrupted_;
        result.fragments = exchange_.fragments();
        result.seconds = transfer_.seconds();
        // A direction sees a patch of area A under A/2 on average.
        const double pixel_area = transfer_.pixel_size() * transfer_.pixel_size();
        result.escaped = component_.escaped() * (2.0 * std::numbers::pi * pixel_area);
        result.entered = component_.entered() * (2.0 * std::numbers::pi * pixel_area);
        result.glossy_elements = component_.glossy_values();
        add_residual_to(result);
        result.sums = std::move(kept_);
        return result;
    }

    void add_residual_to(TransportResult& result) const {
        result.monte_carlo = representation_;
        result.carried = carried();
        result.carried_anew_at = carried_anew_at_;
        result.carried_to_the_end = transfer_.residual() != nullptr;
        result.residual_effect = residual_effect_;
        // Along the first direction nothing is carried yet.
        if (transfer_.carried() < 2) return;
        const double directions = static_cast<double>(transfer_.carried()) - 1.0;
        for (std::uint32_t p = 0; p < component_.patch_count(); ++p) {
            const ResidualNorms norms = transfer_.norms(p);
            result.spatial_error.push_back(saturated(norms.spatial / directions));
            result.directional_error.push_back(saturated(norms.directional / directions));
        }
    }

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    const IterationOptions& options_;
    const Workers& workers_;
    Monitor& monitor_;
    BundleTransfer transfer_;
    Clusters clusters_;
    ClusterTransfer between_clusters_, earlier_between_clusters_;
    Exchange exchange_;
    FiniteElementComponent component_;
    const Environment& environment_;
    const std::vector<GlossySide>& sides_;
    std::vector<double> leaf_area_;
    ErrorEstimate error_;
    MonteCarlo representation_ = MonteCarlo::off;
    std::optional<ResidualEffect> effect_;  ///< while it is being measured
    std::uint64_t effect_begin_ = 0;
    float brightest_so_far_ = 0.0f;  ///< of the environment
    bool restarts_ = false;          ///< at the next power of two
    double residual_effect_ = std::numeric_limits<double>::quiet_NaN();
    CarriedBefore carried_before_;
    std::uint64_t done_ = 0, restarted_at_ = 0, carried_anew_at_ = 0;
    double relative_error_ = std::numeric_limits<double>::quiet_NaN();
    bool interrupted_ = false;
    std::vector<GlossySum> glossy_sums_;  ///< at the last block's beginning, where they are kept
    std::shared_ptr<const IterationSums> kept_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

TransportResult iterate(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                        const PatchSources& sources, const IterationOptions& options,
                        const Workers& workers, Monitor& monitor) {
    if (options.iterations > std::numeric_limits<std::uint32_t>::max())
        throw UsageError("iterations " + std::to_string(options.iterations) +
                         "; accepted: below 2^32");
    return Iteration(mesh, patches, sources, options, workers, monitor).run();
}

}  // namespace transillum
