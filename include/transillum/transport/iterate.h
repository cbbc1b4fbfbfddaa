/// Stochastic iteration of the light transport with parallel ray bundles (paper §2.2 and §3).
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/base/spectrum.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/scene/environment.h>
#include <transillum/transport/glossy_sides.h>
#include <transillum/visibility/stage_seconds.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace transillum {

enum class Averaging {
    balanced,  ///< growing weights, feedback refreshed in blocks, energy balance at powers of two
    paper,     ///< eq. (5): the 1/m average is fed back after every direction
    /// Nothing is fed back but what the last bundle brought, all of it, patch by patch: stochastic
    /// iteration with ray bundles and no finite elements (paper, reference 22), to compare with.
    /// The result is the average.
    none
};

/// Representation of the Monte-Carlo component (paper §3.1), which is carried from bundle to
/// bundle.
enum class MonteCarlo {
    automatic,  ///< by the number of patches, and only where it is worth it
    off,
    subpatch,  ///< constant on the quarters of every patch (§3.1.2)
    wavefront  ///< in the last transillumination buffer (§3.1.1)
};

/// What an iteration of these options carries: plain iteration has nothing else.
[[nodiscard]] inline MonteCarlo carried_by(MonteCarlo monte_carlo, Averaging averaging) {
    const bool is_open = monte_carlo == MonteCarlo::off || monte_carlo == MonteCarlo::automatic;
    return averaging == Averaging::none && is_open ? MonteCarlo::subpatch : monte_carlo;
}

/// Memory [bytes] that carrying it will take.
[[nodiscard]] std::uint64_t monte_carlo_bytes(MonteCarlo monte_carlo, const SurfaceMesh& mesh,
                                              const PatchHierarchy& patches, double pixel_size,
                                              int threads);

/// What an iteration has summed up, for another to go on from.
struct IterationSums;

struct IterationOptions {
    std::uint64_t iterations = 1024;  ///< most directions, each transferred both ways
    /// Stop when the estimated relative error is below it by a fifth, so that the true one most
    /// likely is below, too; 0: never.
    double target_error = 0.0;
    double seconds =
        0.0;  ///< stop after that time; 0: never. The result then depends on the machine's speed
    double pixel_size = 0.0;  ///< of the transillumination buffer [scene units]
    std::uint64_t seed = 1;
    Averaging averaging = Averaging::balanced;
    MonteCarlo monte_carlo = MonteCarlo::off;
    /// Of an earlier run over the same roots, whose patches and bins may have been split since:
    /// children inherit its sums (paper §3.2), and its directions count. Null: from the beginning.
    std::shared_ptr<const IterationSums> start;
    bool keep_sums = false;
};

/// Light of the first shot that arrives at a patch from about one direction.
struct IncomingLight {
    glm::vec3 direction{0.0f, 0.0f, 1.0f};  ///< unit, towards the light, in the side's bin_frame
    Spectrum irradiance{0.0f};              ///< [W m^-2]
    float solid_angle = 0.0f;  ///< that it comes from [sr]; 0: of a light without extent
};

/// What every patch contributes on its own: one entry a patch of the hierarchy.
struct PatchSources {
    std::vector<Spectrum> emission;  ///< emitted radiance that travels by iteration [W sr^-1 m^-2]
    /// Radiance reflected from the first shot [W sr^-1 m^-2]; its cosine-weighted mean on glossy
    /// sides.
    std::vector<Spectrum> direct;
    std::vector<Spectrum> albedo;  ///< of the Lambert part; 0 for a black back
    GlossySides glossy;            ///< may be empty, of_root_side with it
    /// Of glossy sides' patches, instead of `direct`: entries [first_incoming[p],
    /// first_incoming[p + 1]), so that the lobe reflects them towards each new direction (paper
    /// §4). Both empty without a first shot on glossy sides.
    std::vector<std::uint32_t> first_incoming;
    std::vector<IncomingLight> incoming;
    /// Emission of glossy sides that depends on the direction, beside `emission`
    /// [W sr^-1 m^-2]: by side and unit direction in its bin_frame. Empty for none.
    std::function<Spectrum(const GlossySide& side, const glm::vec3& out)> directional_emission;
    Environment environment;
};

struct TransportResult {
    std::vector<Spectrum> irradiance;  ///< one a patch, of emission and direct after any number of
                                       ///< reflections [W m^-2]
    /// Of the irradiance [W m^-2], from the spread between blocks of directions, scaled to agree
    /// with the relative error: blocks of a low-discrepancy sequence make up for each other. As
    /// large as the irradiance where there were too few blocks to tell.
    std::vector<Spectrum> standard_error;
    std::vector<float> coverage;            ///< fragments seen, over all directions
    std::vector<Spectrum> glossy_elements;  ///< as glossy_sides.h lays them out
    std::uint64_t iterations = 0;
    double relative_error = 0.0;  ///< root of the area-weighted mean of squared errors over the
                                  ///< mean irradiance; 1 where unknown
    bool interrupted = false;
    SpectrumSum escaped{0.0};     ///< flux that left the scene [radiance * sr * square scene units]
    SpectrumSum entered{0.0};     ///< flux that came in from the environment, likewise
    std::uint64_t fragments = 0;  ///< exchanged, over all directions
    StageSeconds seconds;         ///< of threads, in the transillumination buffer

    std::shared_ptr<const IterationSums> sums;  ///< where they were to be kept

    /// Of the Monte-Carlo component: how it was represented, for how many directions it was
    /// carried, and how much of the mean of what patches receive came with it, as far as that was
    /// measured: NaN unless automatic.
    MonteCarlo monte_carlo = MonteCarlo::off;
    std::uint64_t carried = 0;
    bool carried_to_the_end = false;
    /// Number of directions at which it was begun once more, where that of an earlier run was not
    /// at hand; 0 otherwise.
    std::uint64_t carried_anew_at = 0;
    double residual_effect = std::numeric_limits<double>::quiet_NaN();
    /// Its norms (§3.2) [W^2 sr^-2 m^-4], one a patch, means over directions of the luminance: V_s,
    /// its variance within a patch, and V_d, the square of its mean; at most what a float holds.
    /// Empty unless carried.
    std::vector<float> spatial_error, directional_error;
};

/// \pre every vector of `sources` has patches.patch_count() finite, non-negative entries, albedo at
/// most 1. \throws UsageError when light would never fade: nothing absorbs and nothing leaves the
/// scene. The result depends neither on the number of workers nor, unless time stops it, on the
/// machine.
[[nodiscard]] TransportResult iterate(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                      const PatchSources& sources, const IterationOptions& options,
                                      const Workers& workers, Monitor& monitor);

}  // namespace transillum
