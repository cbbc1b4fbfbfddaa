#include "transport/finite_elements.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace transillum {

namespace {

constexpr std::size_t grain = 16384;
constexpr int least_blocks_for_error = 4;
/// A patch that but one block met, or next to, has no spread: as many equal ones would tell as
/// much.
constexpr double least_equal_blocks = 1.5;
/// Weight that an earlier estimate keeps beside the first new fragments.
constexpr double prior_weight = 0x1p-14;

void add(PatchSums& s, const Received& block, double weight) {
    if (block.coverage == 0.0) return;
    const SpectrumSum r = weight * block.radiance;
    const double c = weight * block.coverage;
    s.received += r;
    s.coverage += c;
    s.fragments += block.coverage;
    s.received_squared += r * r;
    s.received_coverage += r * c;
    s.coverage_squared += c * c;
}

}  // namespace

PatchSums& operator+=(PatchSums& a, const PatchSums& b) {
    a.received += b.received;
    a.coverage += b.coverage;
    a.fragments += b.fragments;
    a.received_squared += b.received_squared;
    a.received_coverage += b.received_coverage;
    a.coverage_squared += b.coverage_squared;
    return a;
}

FiniteElementComponent::FiniteElementComponent(const SurfaceMesh& mesh,
                                               const PatchHierarchy& patches,
                                               const PatchSources& sources, const Workers& workers)
    : mesh_(mesh),
      patches_(patches),
      sources_(sources),
      workers_(workers),
      glossy_(mesh, patches, sources, workers),
      sums_(sources.albedo.size()),
      radiance_(sources.albedo.size()),
      ratio_(glossy_.empty() ? 0 : sources.albedo.size()) {}

void FiniteElementComponent::average_in(Exchange& exchange, std::uint64_t directions, double weight,
                                        ResidualEffect* effect) {
    workers_.for_ranges(sums_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto patch = static_cast<std::uint32_t>(i);
            const Received block =
                glossy_.side_of(patch) ? glossy_.take(patch) : exchange.take(patch);
            add(sums_[i], block, weight);
            if (effect) effect->take(patch, block);
        }
    });
    escaped_ += weight * exchange.take(patch_count()).radiance;
    entered_ += weight * exchange.take_entered().radiance;
    weights_ += weight * static_cast<double>(directions);
    ++blocks_;
}

void FiniteElementComponent::restore(std::span<const Spectrum> irradiance,
                                     std::span<const Spectrum> glossy_values) {
    for (std::size_t p = 0; p < sums_.size(); ++p) {
        sums_[p] = {};
        sums_[p].coverage = 1.0;
        sums_[p].received = SpectrumSum(irradiance[p]) * std::numbers::inv_pi;
    }
    glossy_.restore(glossy_values);
}

void FiniteElementComponent::set_sums(FiniteElementSums sums, FiniteElementSums earlier) {
    sums_ = std::move(sums.patches);
    glossy_.set_sums(std::move(sums.glossy), std::move(earlier.glossy));
    escaped_ = sums.escaped;
    entered_ = sums.entered;
    weights_ = sums.weights;
    blocks_ = sums.blocks;
    earlier_ = std::move(earlier.patches);
    earlier_blocks_ = earlier.blocks;
}

void FiniteElementComponent::restart() {
    earlier_.resize(sums_.size());
    earlier_blocks_ = blocks_;
    workers_.for_ranges(sums_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t p = begin; p < end; ++p) {
            PatchSums& s = sums_[p];
            earlier_[p] = s;
            if (s.coverage == 0.0) continue;
            PatchSums start;
            start.fragments = s.fragments;
            start.coverage = prior_weight;
            start.received = s.received / s.coverage * prior_weight;
            s = start;
        }
    });
    glossy_.restart(prior_weight);
    escaped_ = entered_ = SpectrumSum(0.0);
    weights_ = 0.0;
    blocks_ = 0;
}

PatchSums FiniteElementComponent::with_earlier(std::uint32_t patch) const {
    PatchSums s = sums_[patch];
    if (earlier_.empty()) return s;
    s += earlier_[patch];
    s.fragments = sums_[patch].fragments;  // which no restart sets aside
    return s;
}

int FiniteElementComponent::blocks_with_earlier() const {
    if (earlier_.empty()) return blocks_;
    return earlier_blocks_ > 0 ? blocks_ + earlier_blocks_ : 0;
}

void FiniteElementComponent::recall() {
    if (earlier_.empty()) return;
    workers_.for_ranges(earlier_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t p = begin; p < end; ++p)
            sums_[p] = with_earlier(static_cast<std::uint32_t>(p));
    });
    blocks_ = blocks_with_earlier();
    glossy_.recall();
    forget();
}

void FiniteElementComponent::forget() {
    earlier_.clear();
    earlier_.shrink_to_fit();
    earlier_blocks_ = 0;
    glossy_.forget();
}

SpectrumSum FiniteElementComponent::incoming(std::uint32_t patch) const {
    return glossy_.side_of(patch) ? glossy_.incoming(patch, Spectrum(ratio(patch))) : ratio(patch);
}

SpectrumSum FiniteElementComponent::ratio(std::uint32_t patch) const {
    const PatchSums& s = sums_[patch];
    // Residuals that were carried have either sign: where there is hardly any light, their sum may
    // be negative; where there is hardly any more than can be, above that.
    return s.coverage > 0.0 ? glm::clamp(s.received / s.coverage, SpectrumSum(0.0), most_incoming_)
                            : SpectrumSum(0.0);
}

void FiniteElementComponent::scale_incoming(std::uint32_t patch, const SpectrumSum& factor) {
    PatchSums& s = sums_[patch];
    s.received *= factor;
    s.received_squared *= factor * factor;
    s.received_coverage *= factor;
    if (glossy_.side_of(patch)) glossy_.scale_incoming(patch, factor);
}

void FiniteElementComponent::set_incoming(std::uint32_t patch, const SpectrumSum& incoming) {
    PatchSums& s = sums_[patch];
    s.received = incoming * s.coverage;
    if (glossy_.side_of(patch)) glossy_.set_incoming(patch, incoming);
}

SpectrumSum FiniteElementComponent::incoming_variance(std::uint32_t patch) const {
    const PatchSums s = with_earlier(patch);
    const int blocks = blocks_with_earlier();
    const bool is_told = s.coverage * s.coverage >= least_equal_blocks * s.coverage_squared;
    if (blocks < least_blocks_for_error || s.coverage == 0.0 || !is_told)
        return SpectrumSum(std::numeric_limits<double>::quiet_NaN());
    // Linearised variance of a ratio of sums: sum of (w C)^2 (x_b - x)^2 over (sum of w C)^2.
    const SpectrumSum x = s.received / s.coverage;
    const SpectrumSum spread =
        s.received_squared - 2.0 * x * s.received_coverage + x * x * s.coverage_squared;
    return glm::max(spread, SpectrumSum(0.0)) / (s.coverage * s.coverage) *
           (blocks / (blocks - 1.0));
}

SpectrumSum FiniteElementComponent::reflected(std::uint32_t patch) const {
    return glossy_.side_of(patch) ? glossy_.reflected(patch, Spectrum(ratio(patch)))
                                  : SpectrumSum(sources_.albedo[patch]) * incoming(patch);
}

SpectrumSum FiniteElementComponent::source(std::uint32_t patch) const {
    const SpectrumSum own =
        SpectrumSum(sources_.emission[patch]) + SpectrumSum(sources_.direct[patch]);
    return glossy_.side_of(patch) ? own + SpectrumSum(glossy_.mean_emission(patch)) : own;
}

SpectrumSum FiniteElementComponent::mean_albedo(std::uint32_t patch) const {
    return SpectrumSum(glossy_.side_of(patch) ? glossy_.mean_albedo(patch)
                                              : sources_.albedo[patch]);
}

std::vector<Spectrum> FiniteElementComponent::glossy_values() const {
    if (glossy_.empty()) return {};
    std::vector<Spectrum> ratios(patch_count());
    for (std::uint32_t p = 0; p < patch_count(); ++p) ratios[p] = Spectrum(ratio(p));
    return glossy_.values(ratios);
}

void FiniteElementComponent::send(Exchange& exchange, float brightest_environment,
                                  double most_fragments, float headroom) {
    const auto reflect_patch = [&](float& largest, std::size_t i) {
        const SpectrumSum in =
            feeds_back_ ? ratio(static_cast<std::uint32_t>(i)) : SpectrumSum(0.0);
        if (!ratio_.empty()) ratio_[i] = Spectrum(in);
        radiance_[i] = sources_.emission[i] + sources_.direct[i] +
                       Spectrum(SpectrumSum(sources_.albedo[i]) * in);
        largest = std::max(largest, max_channel(radiance_[i]));
    };
    float largest = fold(workers_, sums_.size(), brightest_environment, reflect_patch,
                         [](float& all, float part) { all = std::max(all, part); });
    if (!glossy_.empty()) largest = std::max(largest, glossy_.update_incoming(ratio_));
    exchange.set_radiance(radiance_, headroom * largest, most_fragments);
}

void FiniteElementComponent::leave_reflection_to_residual() {
    feeds_back_ = false;
    glossy_.leave_reflection_to_residual();
}

void FiniteElementComponent::send_along(Exchange& exchange, const Bundle& bundle) const {
    glossy_.send(exchange, bundle);
}

void FiniteElementComponent::reflect_residual(const Bundle& last, const Bundle& next,
                                              const MonteCarloComponent& residual,
                                              std::span<BundleReflection> reflections) const {
    constexpr std::size_t roots_at_once = 256;
    const std::size_t roots = patches_.roots.size();
    workers_.for_ranges(roots, roots_at_once, [&](std::size_t begin, std::size_t end, int) {
        for (auto root = static_cast<std::uint32_t>(begin); root < end; ++root) {
            const auto twice_cosine =
                static_cast<float>(2.0 * std::abs(glm::dot(normal_of(mesh_, root), last.frame[2])));
            const std::uint32_t first = patches_.roots[root].first_leaf;
            for (std::uint32_t leaf = first; leaf < first + patches_.leaves_of(root); ++leaf)
                for (const std::uint32_t patch : {leaf, leaf + patches_.leaf_count}) {
                    const std::uint32_t slot = slot_of_patch(patch, patches_.leaf_count);
                    // Of a patch that met no pixel there is no mean to tell a residual from.
                    const bool met = residual.arrived(slot).coverage > 0.0f;
                    const Spectrum gain = met || !feeds_back_
                                              ? twice_cosine * sources_.albedo[patch]
                                              : Spectrum(0.0f);
                    const Spectrum projected = feeds_back_ ? gain : Spectrum(0.0f);
                    reflections[slot] = {lanes_of(gain),
                                         lanes_of(projected * residual.arrived(slot).radiance)};
                }
        }
    });
    glossy_.reflect_residual(last, next, residual, reflections);
}

void FiniteElementComponent::receive_along(Exchange& exchange, const Bundle& bundle,
                                           double weight) {
    glossy_.receive(exchange, bundle, weight);
}

}  // namespace transillum
