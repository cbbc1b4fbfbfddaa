/// The finite elements of glossy sides: rows of direction bins (paper §2.1, eq. 4).
///
/// All leaves of a side share a bundle's direction, in which they both receive and send. What
/// arrives along it is added to the row of its bin, coverage likewise; the ratio of the two is a
/// mean of incoming radiance (design 4.3). Rows lie one behind the other, so that a bundle streams
/// through them.
#pragma once

#include "transport/exchange.h"
#include "transport/monte_carlo_component.h"

#include <transillum/transport/iterate.h>
#include <transillum/transport/projected_brdf.h>

#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

/// Red, green, blue and coverage. Float: a thousand positive terms lose some 1e-6 of their sum, far
/// less than their statistical error.
using GlossySum = float __attribute__((vector_size(16)));

class GlossyElements {
public:
    /// Keeps references.
    GlossyElements(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                   const PatchSources& sources, const Workers& workers);

    [[nodiscard]] bool empty() const { return sides_.empty(); }
    /// Null for a patch without a lobe.
    [[nodiscard]] const GlossySide* side_of(std::uint32_t patch) const;

    /// Turns sums into the radiance that is reflected from now on. \param fallback mean incoming
    /// radiance a patch, for bins no light has come from. \returns a bound of what any patch sends.
    float update_incoming(const std::vector<Spectrum>& fallback);
    /// Gives the exchange what the glossy sides send along a bundle.
    void send(Exchange& exchange, const Bundle& bundle) const;
    /// Takes from the exchange what they received along it.
    void receive(Exchange& exchange, const Bundle& bundle, double weight);
    /// What a patch has received since this was last called.
    [[nodiscard]] Received take(std::uint32_t patch);

    // FiniteElementComponent's, of glossy sides.
    void leave_reflection_to_residual() { feeds_back_ = false; }
    void reflect_residual(const Bundle& last, const Bundle& next,
                          const MonteCarloComponent& residual,
                          std::span<BundleReflection> reflections) const;
    /// Bound of a residual over what arrives.
    [[nodiscard]] float largest_gain() const;

    /// Means over directions, weighted with the cosine: of the incoming radiance, and of what is
    /// reflected of it. The second is at most the first times the albedo.
    [[nodiscard]] SpectrumSum incoming(std::uint32_t patch, const Spectrum& fallback) const;
    [[nodiscard]] SpectrumSum reflected(std::uint32_t patch, const Spectrum& fallback) const;
    /// Of directional emission, weighted with the cosine.
    [[nodiscard]] Spectrum mean_emission(std::uint32_t patch) const;
    [[nodiscard]] Spectrum mean_albedo(std::uint32_t patch) const;
    void scale_incoming(std::uint32_t patch, const SpectrumSum& factor);
    void set_incoming(std::uint32_t patch, const SpectrumSum& incoming);

    // As FiniteElementComponent's.
    void restore(std::span<const Spectrum> values);
    [[nodiscard]] const std::vector<GlossySum>& sums() const { return sums_; }
    [[nodiscard]] const std::vector<GlossySum>& earlier_sums() const { return earlier_; }
    void set_sums(std::vector<GlossySum> sums, std::vector<GlossySum> earlier) {
        sums_ = std::move(sums);
        earlier_ = std::move(earlier);
    }
    void restart(float prior_weight);
    void recall();
    void forget();

    /// Incoming radiance by bin, as glossy_sides.h lays it out.
    [[nodiscard]] std::vector<Spectrum> values(const std::vector<Spectrum>& fallback) const;

private:
    using Sum = GlossySum;
    /// Leaves of one side that one thread handles at once.
    struct Chunk {
        std::uint32_t side, begin, end;
    };

    [[nodiscard]] std::uint32_t number_of(const GlossySide& side) const {
        return static_cast<std::uint32_t>(&side - sides_.data());
    }
    [[nodiscard]] const ProjectedBrdf& projected(const GlossySide& side) const {
        return sources_.glossy.projections[side.projection];
    }
    [[nodiscard]] const Brdf& brdf(const GlossySide& side) const {
        return sources_.glossy.brdfs[side.brdf];
    }
    [[nodiscard]] glm::vec3 direction_above(std::uint32_t side, const Bundle& bundle) const;
    [[nodiscard]] Spectrum ratio(std::uint64_t element, const Spectrum& fallback) const;
    /// \param coupling of the Lambert part towards `out`, over pi and its mean
    [[nodiscard]] Spectrum direct_towards(const GlossySide& side, std::uint32_t patch,
                                          const glm::vec3& out, float coupling) const;
    void sample_emission();
    /// Bound of what a patch reflects of the first shot.
    [[nodiscard]] float direct_peak(const GlossySide& side, std::uint32_t patch) const;
    template <class Body>
    void for_chunks(Body body) const;
    template <class Body>
    void for_bins(std::uint32_t patch, Body body);

    const PatchSources& sources_;
    const std::vector<GlossySide>& sides_;
    const PatchHierarchy& patches_;
    const Workers& workers_;
    std::vector<glm::mat3> local_from_world_;  ///< one a side
    std::vector<Chunk> chunks_;
    std::vector<Sum> sums_, earlier_;                ///< one an element
    std::vector<Sum> incoming_;                      ///< ratios, one an element, of this block
    std::vector<Received> block_;                    ///< one a glossy patch
    std::vector<std::uint32_t> first_glossy_patch_;  ///< one a side, into block_
    std::vector<Spectrum> mean_emission_;            ///< one a side, or empty
    bool feeds_back_ = true;
    float largest_source_ = 0.0f;  ///< beside emission and what the elements reflect
};

template <class Body>
void GlossyElements::for_chunks(Body body) const {
    constexpr std::size_t grain = 16;
    workers_.for_ranges(chunks_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t c = begin; c < end; ++c) body(chunks_[c]);
    });
}

/// Where a mirror would send light that comes from `d`.
[[nodiscard]] inline glm::vec3 mirrored(const glm::vec3& d) {
    return {-d.x, -d.y, d.z};
}

}  // namespace transillum
