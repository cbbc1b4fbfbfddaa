/// The Monte-Carlo component (paper §2.1, eq. 3): what a bundle's light is reflected to beside its
/// projection onto the finite elements. It is kept for one step (§3.1) and carried by the next
/// bundle, so that patches receive what they would from a finer solution.
///
/// Of what arrived along the last direction d, a point x of patch p sends towards the next, d',
///     dL(x, d') = gain_p L_in(x) - projection_p,
///     gain = 2 pi cos theta f_r(d, d'),   projection = 2 pi cos theta f~_r(d, d') * mean of L_in.
/// Only what the finite elements sent is reflected this way, once: fed back without end, its
/// variance would grow without bound where lobes are high.
#pragma once

#include "transport/exchange.h"

#include <transillum/base/parallel.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/transport/bundle_light.h>

#include <memory>
#include <span>
#include <vector>

namespace transillum {

/// One a slot. Red, green and blue, then nothing; zeros where nothing is to be carried.
struct BundleReflection {
    using Lanes = float __attribute__((vector_size(16)));
    Lanes gain{}, projection{};
};

[[nodiscard]] inline BundleReflection::Lanes lanes_of(const Spectrum& s) {
    return BundleReflection::Lanes{s.x, s.y, s.z, 0.0f};
}

/// Norms of the component over a patch (§3.2), of its luminance: sums over directions.
struct ResidualNorms {
    double spatial = 0.0;      ///< of V_s: mean square deviation from the patch's mean
    double directional = 0.0;  ///< of V_d: square of the patch's mean
};

/// What the finite elements sent to a patch along one bundle.
struct Arrived {
    Spectrum radiance{0.0f};  ///< mean over its fragments
    float coverage = 0.0f;    ///< their number
};

enum class Carried {
    residual,    ///< of what the elements sent, what they can't hold
    everything,  ///< all that arrived, again and again: where there is nothing beside it
    nothing      ///< what the elements sent is only kept, to be looked up; patches receive nothing
};

class MonteCarloComponent {
public:
    virtual ~MonteCarloComponent() = default;

    /// The leaves that the lists of the transillumination buffer must hold.
    [[nodiscard]] virtual const PatchHierarchy& cells() const = 0;

    /// Sets how what arrived along the last bundle is reflected along the next. The first time,
    /// nothing has arrived. \pre something is carried
    virtual void reflect(std::span<const BundleReflection> reflections,
                         const Exchange& exchange) = 0;

    // The steps of a transfer: before it, for every tile (several at once), after it.
    virtual void begin(const Bundle& bundle) = 0;
    virtual void exchange_tile(const TileLists& tile, const TransilluminationBuffer& buffer,
                               const ExchangeTables& tables, int cluster_row, ExchangeTally& tally,
                               int worker) = 0;
    virtual void end(const TransilluminationBuffer& buffer, const ExchangeTables& tables) = 0;

    /// Mean of what the finite elements sent to a slot along the last bundle, and its coverage.
    [[nodiscard]] const Arrived& arrived(std::uint32_t slot) const { return arrived_[slot]; }
    /// Takes the mean for known where there is no coverage.
    void assume(std::uint32_t slot, const Spectrum& radiance) {
        arrived_[slot].radiance = radiance;
    }
    /// Radiance of the finite elements that arrived along the last bundle at a point of a patch,
    /// and over a side of one of the cells; the patch's mean where no sample tells better.
    [[nodiscard]] virtual Spectrum incoming(const SurfaceSide& point) const = 0;
    [[nodiscard]] virtual Spectrum incoming_of_cell(std::uint32_t cell_patch) const = 0;
    /// Norms of a slot, over so many directions.
    [[nodiscard]] const ResidualNorms& norms(std::uint32_t slot) const { return norms_[slot]; }
    [[nodiscard]] std::uint64_t directions() const { return directions_; }

protected:
    MonteCarloComponent(std::uint32_t leaf_count, Carried carried)
        : carried_(carried),
          arrived_(2 * std::size_t{leaf_count}),
          norms_(2 * std::size_t{leaf_count}) {}

    Carried carried_;
    std::vector<Arrived> arrived_;
    std::vector<ResidualNorms> norms_;
    std::uint64_t directions_ = 0;
};

/// The object-space representation (§3.1.2): constant on the quarters of every leaf.
[[nodiscard]] std::unique_ptr<MonteCarloComponent> make_subpatch_component(
    const PatchHierarchy& patches, Carried carried, const Workers& workers);

/// The image-space representation (§3.1.1): the last transillumination buffer, kept whole with what
/// arrived at each of its points. Looked up by coplanar group of roots, else by depth, and facing.
[[nodiscard]] std::unique_ptr<MonteCarloComponent> make_wavefront_component(
    const SurfaceMesh& mesh, const PatchHierarchy& patches, Carried carried,
    const Workers& workers);

}  // namespace transillum
