/// The refinement oracle (paper §3.2): which leaves are too coarse for the radiance on them.
///
/// The paper measures by V_s how the radiance of one direction varies over a patch. A wavefront has
/// hard edges even where its average is smooth, so here means of the averaged radiance over the
/// children of leaves are compared. Pictures interpolate between leaves, so a large leaf beside an
/// edge is as wrong as one across it: a leaf splits where the children that meet at a corner of its
/// own children differ by more than both the tolerance and what their standard errors explain.
#pragma once

#include <transillum/base/spectrum.h>
#include <transillum/geometry/split_leaves.h>
#include <transillum/geometry/surface_mesh.h>

#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

struct SplitOptions {
    double tolerance = 0.1;        ///< between children that meet, over the mean of the scene
    std::uint32_t max_leaves = 0;  ///< of the result; 0: no limit. The widest spreads go first
    int max_level = 8;             ///< of the result, below max_subdivision_level
};

struct SplitChoice {
    std::vector<std::uint8_t> split;  ///< one a leaf, as split_leaves takes it
    std::uint32_t count = 0;
    bool limited = false;  ///< more leaves were wanted than allowed
};

/// Area-weighted mean luminance over all patches that shine at all: what tolerances refer to.
[[nodiscard]] double mean_luminance(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                    std::span<const Spectrum> radiance);

/// \param patches the leaves in question; \param children every one of them split
/// \param radiance, error mean over each child patch of the finite elements, and its standard error
/// [W sr^-1 m^-2]
/// \param direct the same without an error: of the first shot; empty where it is of no account
[[nodiscard]] SplitChoice choose_splits(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                        const SplitPatches& children,
                                        std::span<const Spectrum> radiance,
                                        std::span<const Spectrum> error,
                                        std::span<const Spectrum> direct,
                                        const SplitOptions& options);

}  // namespace transillum
