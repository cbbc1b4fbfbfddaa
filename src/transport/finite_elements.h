/// The finite-element component: one averaged estimate a patch (paper eq. 4 and 5).
///
/// Ratio estimator (design 4.3): both what arrived and how often a patch was seen are summed; their
/// ratio, times the albedo, is a convex combination of other radiances times an albedo, so energy
/// can't be created.
#pragma once

#include "transport/exchange.h"
#include "transport/glossy_elements.h"
#include "transport/monte_carlo_component.h"
#include "transport/residual_effect.h"

#include <transillum/transport/iterate.h>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace transillum {

/// Sums of one patch. Blocks of directions come with weight w.
/// Double: blocks differ in size by orders of magnitude, and the error is a difference of large
/// sums.
struct PatchSums {
    SpectrumSum received{0.0};  ///< sum of w R
    double coverage = 0.0;      ///< sum of w C
    double fragments = 0.0;     ///< sum of C over all directions there ever were
    // For the standard error: sums over blocks of w^2 R^2, w^2 R C and w^2 C^2.
    SpectrumSum received_squared{0.0};
    SpectrumSum received_coverage{0.0};
    double coverage_squared = 0.0;
};
PatchSums& operator+=(PatchSums& a, const PatchSums& b);

/// All that the component has summed up, for the current average.
struct FiniteElementSums {
    std::vector<PatchSums> patches;
    std::vector<GlossySum> glossy;  ///< one an element
    SpectrumSum escaped{0.0}, entered{0.0};
    double weights = 0.0;
    int blocks = 0;
};

class FiniteElementComponent {
public:
    /// Keeps references.
    FiniteElementComponent(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                           const PatchSources& sources, const Workers& workers);

    /// Refreshes what is sent: emission, first reflection, and what the elements reflect.
    /// \param brightest_environment bound of its radiance
    /// \param headroom bound of what a point sends over what any patch does
    void send(Exchange& exchange, float brightest_environment, double most_fragments,
              float headroom = 1.0f);
    /// From now on what is sent is emission and first reflection; all that is reflected beside it
    /// is left to the residual.
    void leave_reflection_to_residual();
    /// The part of it that differs from bundle to bundle.
    void send_along(Exchange& exchange, const Bundle& bundle) const;
    /// Takes what arrives at sides whose BRDF weighs bundles unlike. \param weight of the direction
    void receive_along(Exchange& exchange, const Bundle& bundle, double weight);

    /// How patches reflect what arrived along one bundle towards the next, beside the elements.
    /// \param reflections one a slot of the exchange
    void reflect_residual(const Bundle& last, const Bundle& next,
                          const MonteCarloComponent& residual,
                          std::span<BundleReflection> reflections) const;

    /// Bound of a residual over what arrives.
    [[nodiscard]] float largest_gain() const { return 2.0f + glossy_.largest_gain(); }

    /// Sets the estimate, as if one fragment a patch and bin had brought it.
    void restore(std::span<const Spectrum> irradiance, std::span<const Spectrum> glossy_values);
    [[nodiscard]] FiniteElementSums sums() const {
        return {sums_, glossy_.sums(), escaped_, entered_, weights_, blocks_};
    }
    /// What the last restart set aside; empty where that was recalled or let go of.
    [[nodiscard]] FiniteElementSums earlier_sums() const {
        return {earlier_, glossy_.earlier_sums(), {}, {}, 0.0, earlier_blocks_};
    }
    /// The glossy sides' share of sums(): the only one that changes within a block.
    [[nodiscard]] const std::vector<GlossySum>& glossy_sums() const { return glossy_.sums(); }
    /// Goes on from these.
    void set_sums(FiniteElementSums sums, FiniteElementSums earlier);

    /// Takes a block of directions. \param weight of each of its directions in the average.
    /// \param effect told what every patch received, where given
    void average_in(Exchange& exchange, std::uint64_t directions, double weight,
                    ResidualEffect* effect = nullptr);
    /// Sets what was summed aside, keeping the estimate as the start of a new average, with next to
    /// no weight.
    void restart();
    /// Adds what the last restart set aside: a run that ends soon after cannot do without it.
    void recall();
    /// Lets go of what the last restart set aside.
    void forget();
    /// No estimate of what arrives exceeds this from now on, whatever was summed up.
    void limit_incoming(const SpectrumSum& most) { most_incoming_ = most; }
    /// Says that the spread of the blocks so far tells nothing of the error.
    void forget_error() { blocks_ = 0; }

    /// Mean radiance that arrives at a patch, cosine-weighted; 0 where nothing is known.
    [[nodiscard]] SpectrumSum incoming(std::uint32_t patch) const;
    [[nodiscard]] double coverage(std::uint32_t patch) const { return sums_[patch].coverage; }
    [[nodiscard]] bool reflects(std::uint32_t patch) const {
        return glossy_.side_of(patch) || max_channel(sources_.albedo[patch]) > 0.0f;
    }
    void scale_incoming(std::uint32_t patch, const SpectrumSum& factor);
    void set_incoming(std::uint32_t patch, const SpectrumSum& incoming);
    /// Squared standard error of `incoming`, from the spread of the blocks, those that the last
    /// restart set aside with them; NaN for fewer than 4, or where hardly more than one met the
    /// patch.
    [[nodiscard]] SpectrumSum incoming_variance(std::uint32_t patch) const;

    /// Mean radiance that a patch reflects of `incoming`, weighted with the cosine.
    [[nodiscard]] SpectrumSum reflected(std::uint32_t patch) const;
    /// Mean radiance that a patch sends without the elements, weighted with the cosine.
    [[nodiscard]] SpectrumSum source(std::uint32_t patch) const;
    /// Reflected share of uniform light.
    [[nodiscard]] SpectrumSum mean_albedo(std::uint32_t patch) const;
    [[nodiscard]] bool is_glossy() const { return !glossy_.empty(); }
    /// Incoming radiance of glossy sides by bin, as glossy_sides.h lays it out.
    [[nodiscard]] std::vector<Spectrum> glossy_values() const;

    /// Radiance times fragments that left the scene, mean over the directions.
    [[nodiscard]] SpectrumSum escaped() const {
        return weights_ > 0.0 ? escaped_ / weights_ : SpectrumSum(0.0);
    }
    /// The same of what came in from the environment.
    [[nodiscard]] SpectrumSum entered() const {
        return weights_ > 0.0 ? entered_ / weights_ : SpectrumSum(0.0);
    }
    [[nodiscard]] double fragments(std::uint32_t patch) const { return sums_[patch].fragments; }
    [[nodiscard]] std::uint32_t patch_count() const {
        return static_cast<std::uint32_t>(sums_.size());
    }

private:
    [[nodiscard]] SpectrumSum ratio(std::uint32_t patch) const;
    /// As recall() would make them.
    [[nodiscard]] PatchSums with_earlier(std::uint32_t patch) const;
    [[nodiscard]] int blocks_with_earlier() const;

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    const PatchSources& sources_;
    const Workers& workers_;
    GlossyElements glossy_;
    std::vector<PatchSums> sums_;
    std::vector<Spectrum> radiance_;  ///< when last sent
    std::vector<Spectrum> ratio_;     ///< the same; only where there are glossy sides
    SpectrumSum most_incoming_{std::numeric_limits<double>::infinity()};
    bool feeds_back_ = true;
    SpectrumSum escaped_{0.0}, entered_{0.0};
    double weights_ = 0.0;
    int blocks_ = 0;
    std::vector<PatchSums> earlier_;  ///< set aside by the last restart
    int earlier_blocks_ = 0;
};

}  // namespace transillum
