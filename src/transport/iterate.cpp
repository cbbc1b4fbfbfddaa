// The loop of paper §2.2:
//
//   L^r    = T*_fr (L^e + L~(m-1) + dL(m-1))  transfer, along one bundle and both ways
//   L~'(m) = projection of L^r                Exchange, per patch
//   dL(m)  = L^r - L~'(m)                     MonteCarloComponent, where Carrying has it carried
//   L~(m)  = average of the projections       RunningAverage::end_block
//
// L~ is refreshed after blocks of directions, and balanced at powers of two (design 4.4).
#include <transillum/base/error.h>
#include <transillum/transport/iterate.h>

#include "transport/bundle_transfer.h"
#include "transport/carrying.h"
#include "transport/exchange.h"
#include "transport/iteration_sums.h"
#include "transport/running_average.h"

#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace transillum {

namespace {

/// Runs look at the estimate again and again, and stop where it is low: by so many of its own
/// standard errors it has to be below the target.
constexpr double margin_of_target = 2.0;
/// Longer blocks would leave the fixed-point sums too few bits.
constexpr std::uint64_t longest_block = 1024;

/// Directions until the estimate is refreshed: one at a time up to 8, then four blocks an octave.
std::uint64_t block_length(std::uint64_t done, Averaging averaging) {
    if (averaging == Averaging::paper || done < first_balance) return 1;
    return std::min(std::bit_floor(done) / 4, longest_block);
}

double scene_diagonal(const SurfaceMesh& mesh) {
    glm::dvec3 low(mesh.positions.front()), high(low);
    for (const glm::dvec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::length(high - low);
}

class Iteration {
public:
    Iteration(const SurfaceMesh& mesh, const PatchHierarchy& patches, const PatchSources& sources,
              const IterationOptions& options, const Workers& workers, Monitor& monitor)
        : mesh_(mesh),
          patches_(patches),
          options_(options),
          monitor_(monitor),
          transfer_(mesh, patches, options.pixel_size, options.seed, workers),
          average_(mesh, patches, sources, options.averaging, workers),
          exchange_(patches.leaf_count, average_.clusters(), workers),
          carrying_(patches, options, transfer_, average_, workers),
          environment_(sources.environment),
          sides_(sources.glossy.sides) {
        if (options.start) go_on_from(*options.start, sources.glossy);
    }

    TransportResult run() {
        while (average_.directions() < options_.iterations && !stopped()) {
            carrying_.begin_block();
            average_.begin_block();
            const std::uint64_t begin = average_.directions();
            const std::uint64_t block =
                std::min(block_length(begin, options_.averaging), carrying_.longest_block());
            send(block);
            std::uint64_t in_block = 0;
            if (options_.keep_sums && block > 1) glossy_sums_ = average_.elements().glossy_sums();
            do {
                transfer(transfer_.bundle(begin + in_block), average_.weight_after(block));
                ++in_block;
                monitor_.progress({"transport", begin + in_block, options_.iterations,
                                   average_.relative_error(),
                                   options_.target_error > 0.0 || options_.seconds > 0.0});
            } while (in_block < block && begin + in_block < options_.iterations && !stopped());
            // One that goes on begins the block that was cut short once more.
            if (in_block < block) keep_sums(std::move(glossy_sums_), in_block);
            average_.end_block(exchange_, in_block, transfer_.is_even(begin + in_block),
                               carrying_.effect());
            carrying_.end_block();
        }
        return finish();
    }

private:
    void go_on_from(const IterationSums& sums, const GlossySides& glossy) {
        const bool are_same = is_of(sums, patches_, glossy, options_.pixel_size);
        average_.go_on_from(sums, patches_, glossy, options_.pixel_size, are_same);
        if (are_same) carrying_.go_on_from(sums.carried);
    }

    void send(std::uint64_t block) {
        const float brightest = brightest_environment(block);
        average_.meet_environment(brightest);
        exchange_.set_draw(average_.directions());
        average_.elements().send(exchange_, brightest, most_fragments(block), transfer_.headroom());
    }

    void transfer(const Bundle& bundle, double weight) {
        if (environment_.shines())
            exchange_.set_environment(environment_.radiance(-bundle.frame[2]),
                                      environment_.radiance(bundle.frame[2]));
        if (!sides_.empty()) average_.elements().send_along(exchange_, bundle);
        transfer_.transfer(exchange_, average_.elements(), bundle);
        carrying_.add_direction();
        if (!sides_.empty()) average_.elements().receive_along(exchange_, bundle, weight);
    }

    float brightest_environment(std::uint64_t block) {
        float brightest = 0.0f;
        for (std::uint64_t i = 0; environment_.shines() && i < block; ++i)
            for (const double way : {-1.0, 1.0})
                brightest = std::max(
                    brightest, max_channel(environment_.radiance(
                                   way * transfer_.bundle(average_.directions() + i).frame[2])));
        return brightest;
    }

    /// A patch is a planar triangle: it covers a pixel at most once a direction.
    double most_fragments(std::uint64_t block) const {
        const double diagonal_pixels =
            std::min(16384.0, scene_diagonal(mesh_) / transfer_.pixel_size() + 4.0);
        // The environment is met twice a pixel.
        return 2.0 * diagonal_pixels * diagonal_pixels * static_cast<double>(block);
    }

    bool stopped() {
        if (monitor_.stop_requested()) return interrupted_ = true;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
        return (options_.seconds > 0.0 && elapsed.count() >= options_.seconds) ||
               (options_.target_error > 0.0 && error_with_margin() <= options_.target_error);
    }

    /// NaN where unknown.
    double error_with_margin() const {
        return average_.relative_error() *
               (1.0 + margin_of_target * average_.relative_error_uncertainty());
    }

    /// As they were before this block, of which so many directions are done.
    void keep_sums(std::vector<GlossySum> glossy_sums, std::uint64_t in_block) {
        if (!options_.keep_sums) return;
        auto sums = std::make_shared<IterationSums>();
        sums->patches = patches_;
        sums->sides = sides_;
        sums->pixel_size = transfer_.pixel_size();
        sums->monte_carlo = options_.monte_carlo;
        sums->carried = carrying_.kept(in_block);
        average_.keep(*sums);
        if (!sides_.empty()) sums->elements.glossy = std::move(glossy_sums);
        kept_ = std::move(sums);
    }

    TransportResult finish() {
        if (!kept_) keep_sums(average_.elements().glossy_sums(), 0);
        average_.conclude();
        TransportResult result;
        tell_irradiance(result);
        if (transfer_.is_even(average_.directions())) average_.estimate_relative_error();
        const double error = average_.relative_error();
        result.relative_error = std::isfinite(error) ? error : 1.0;
        result.iterations = average_.directions();
        result.interrupted = interrupted_;
        result.fragments = exchange_.fragments();
        result.seconds = transfer_.seconds();
        // A direction sees a patch of area A under A/2 on average.
        const double pixel_area = transfer_.pixel_size() * transfer_.pixel_size();
        result.escaped = average_.elements().escaped() * (2.0 * std::numbers::pi * pixel_area);
        result.entered = average_.elements().entered() * (2.0 * std::numbers::pi * pixel_area);
        result.glossy_elements = average_.elements().glossy_values();
        carrying_.tell(result);
        result.sums = std::move(kept_);
        return result;
    }

    void tell_irradiance(TransportResult& result) const {
        const FiniteElementComponent& elements = average_.elements();
        const std::uint32_t n = elements.patch_count();
        result.irradiance.resize(n);
        result.standard_error.resize(n);
        result.coverage.resize(n);
        const double correction = average_.correction();
        for (std::uint32_t p = 0; p < n; ++p) {
            result.irradiance[p] = Spectrum(std::numbers::pi * elements.incoming(p));
            const SpectrumSum variance = correction * elements.incoming_variance(p);
            result.standard_error[p] = is_finite(variance)
                                           ? Spectrum(std::numbers::pi * glm::sqrt(variance))
                                           : result.irradiance[p];
            result.coverage[p] = static_cast<float>(elements.fragments(p));
        }
    }

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    const IterationOptions& options_;
    Monitor& monitor_;
    BundleTransfer transfer_;
    RunningAverage average_;
    Exchange exchange_;
    Carrying carrying_;
    const Environment& environment_;
    const std::vector<GlossySide>& sides_;
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
