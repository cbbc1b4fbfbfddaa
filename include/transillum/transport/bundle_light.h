/// Light of single bundles over finished finite elements: what a measurement needs of the
/// Monte-Carlo component (paper §2.2: C' = M(L^e + L~ + dL)).
///
/// At a point x of patch p, of what a bundle from direction d brings, the residual towards `out` is
///     dL(x, out) = 2 pi cos theta (f_r(d, out) L_in(x) - f~_r(d, out) * mean of L_in over p).
/// The second term is linear in what the patch receives: the mean of it over many bundles is what
/// finite elements reflect that hold projected().
#pragma once

#include <transillum/transport/iterate.h>

#include <memory>
#include <span>

namespace transillum {

struct BundleLightOptions {
    MonteCarlo representation = MonteCarlo::subpatch;  ///< subpatch or wavefront
    double pixel_size = 0.0;  ///< of the transillumination buffer [scene units]
    std::uint64_t seed = 1;
};

/// A point of a side of a root.
struct SurfaceSide {
    std::uint32_t root = 0;
    bool back = false;
    float b1 = 0.0f, b2 = 0.0f;  ///< barycentric, of the root's second and third vertex
    glm::dvec3 position{0.0};
};

class BundleLight {
public:
    /// Keeps references to all but the options. \param irradiance, glossy_elements as
    /// TransportResult holds them
    BundleLight(const SurfaceMesh& mesh, const PatchHierarchy& patches, const PatchSources& sources,
                std::span<const Spectrum> irradiance, std::span<const Spectrum> glossy_elements,
                const BundleLightOptions& options, const Workers& workers);
    ~BundleLight();
    BundleLight(BundleLight&&) noexcept;
    BundleLight& operator=(BundleLight&&) noexcept;

    /// Transfers what patches send along one more bundle.
    void next();
    /// So far.
    [[nodiscard]] std::uint64_t bundles() const;

    // Of the last bundle.
    /// [unit] Light comes from it, or from opposite, to whichever side faces it.
    [[nodiscard]] glm::dvec3 direction() const;
    /// Radiance that arrives at a point along it [W sr^-1 m^-2]; its patch's mean where the
    /// representation knows nothing better, and what its elements hold where that knows nothing.
    /// Any number of threads may ask.
    [[nodiscard]] Spectrum incoming(const SurfaceSide& point) const;
    /// The same of a side of one of cells().
    [[nodiscard]] Spectrum incoming_of_cell(std::uint32_t cell_patch) const;
    [[nodiscard]] Spectrum mean_incoming(std::uint32_t patch) const;

    /// Pieces over which incoming() is constant: quarters of the leaves. \pre subpatch
    [[nodiscard]] const PatchHierarchy& cells() const;

    /// What finite elements would hold of the bundles since they were last forgotten.
    struct Projected {
        std::vector<Spectrum> irradiance;       ///< one a patch [W m^-2]
        std::vector<Spectrum> glossy_elements;  ///< as glossy_sides.h lays them out
    };
    [[nodiscard]] Projected projected() const;
    void forget_projected();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace transillum
