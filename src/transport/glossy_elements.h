/// The finite elements of glossy sides: rows of direction bins (paper §2.1, eq. 4).
///
/// All leaves of a side share a bundle's direction d, in which they both receive and send. What
/// arrives along d is added to every row with that row's weight, coverage likewise, and the ratio
/// of the two is a mean of incoming radiance (design 4.3). Rows lie one behind the other, so that a
/// bundle streams through them.
#pragma once

#include "transport/exchange.h"
#include "transport/projected_brdf.h"

#include <transillum/transport/iterate.h>

#include <array>
#include <cstdint>
#include <vector>

namespace transillum {

class GlossyElements {
public:
    static constexpr int most_rows = 1 + bin_count(max_bin_level);

    /// Keeps references.
    GlossyElements(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                   const PatchSources& sources, const Workers& workers);

    [[nodiscard]] bool empty() const { return sides_.empty(); }
    [[nodiscard]] const GlossySide* side_of(std::uint32_t patch) const;

    /// Turns sums into the radiance that is sent from now on. \param fallback mean incoming
    /// radiance a patch, for elements no light has reached. \returns the largest radiance that any
    /// patch may send.
    float update_radiance(const std::vector<Spectrum>& fallback);
    /// Gives the exchange what the glossy sides send along a bundle.
    void send(Exchange& exchange, const Bundle& bundle) const;
    /// Takes from the exchange what they received along it.
    void receive(Exchange& exchange, const Bundle& bundle, double weight);
    /// What a patch has received since this was last called.
    [[nodiscard]] Received take(std::uint32_t patch);

    /// Mean incoming radiance reflected, over outgoing directions weighted with the cosine; by the
    /// sums as they are.
    [[nodiscard]] SpectrumSum reflected(std::uint32_t patch) const;
    [[nodiscard]] Spectrum mean_albedo(std::uint32_t patch) const;
    void scale_incoming(std::uint32_t patch, const SpectrumSum& factor);
    void set_incoming(std::uint32_t patch, const SpectrumSum& incoming);

    // As FiniteElementComponent's.
    void restart(float prior_weight);
    void recall();
    void forget();

    /// Final values, as glossy_sides.h lays them out.
    [[nodiscard]] std::vector<Spectrum> values() const;

private:
    /// Red, green, blue and coverage. Float: a thousand positive terms lose some 1e-6 of their sum,
    /// far less than their statistical error.
    using Sum = float __attribute__((vector_size(16)));
    /// Leaves of one side that one thread handles at once.
    struct Chunk {
        std::uint32_t side, begin, end;
    };
    struct Place {
        const GlossySide* side;
        std::uint32_t leaf;
    };

    [[nodiscard]] Place place_of(std::uint32_t patch) const;
    [[nodiscard]] glm::vec3 direction_above(std::uint32_t side, const Bundle& bundle) const;
    [[nodiscard]] const ProjectedBrdf& projected(const GlossySide& side) const;
    [[nodiscard]] Spectrum ratio(std::uint64_t element, const Spectrum& fallback) const;
    [[nodiscard]] Spectrum direct_towards(const GlossySide& side, std::uint32_t patch,
                                          const glm::vec3& out) const;
    [[nodiscard]] float direct_peak(const GlossySide& side, std::uint32_t patch) const;
    template <class Body>
    void for_chunks(Body body) const;
    template <class Body>
    void for_rows(std::uint32_t patch, Body body);

    const PatchSources& sources_;
    const std::vector<GlossySide>& sides_;
    const PatchHierarchy& patches_;
    const Workers& workers_;
    std::vector<ProjectedBrdf> projected_;  ///< one a material and bin level
    std::vector<std::uint32_t> projected_of_side_;
    std::vector<glm::mat3> local_from_world_;  ///< one a side
    std::vector<Chunk> chunks_;
    std::vector<Sum> sums_, earlier_;                ///< one an element
    std::vector<Spectrum> radiance_;                 ///< one an element, of the block at hand
    std::vector<Received> block_;                    ///< one a glossy patch
    std::vector<std::uint32_t> first_glossy_patch_;  ///< one a side, into block_
    float largest_direct_ = 0.0f;
};

}  // namespace transillum
