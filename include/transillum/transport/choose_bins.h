/// The refinement oracle of solid angles (paper §3.2): which glossy sides have direction bins that
/// are too wide for the light on them.
///
/// The paper measures by V_d how far a patch's reflection of one direction is from its projection.
/// As for patches (choose_splits.h), here the averaged radiance decides: what sides reflect of bins
/// one level deeper, against what they reflect of the means of four.
#pragma once

#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/transport/glossy_sides.h>

#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

/// Levels to try: one deeper than `levels`, where max_bin_level and so many directions allow it:
/// every bin must be met often enough for its mean to be more than noise.
[[nodiscard]] std::vector<std::int8_t> deeper_bins(std::span<const std::int8_t> levels,
                                                   std::uint64_t directions);

struct BinChoice {
    std::vector<std::int8_t> levels;  ///< as lay_out_glossy_sides takes them
    std::uint32_t divided = 0;        ///< sides
};

/// \param levels in question, one a root side \param glossy, elements of a run with deeper ones
/// \param tolerance root mean square, over a side's patches and outgoing directions, of the
/// difference in luminance [W sr^-1 m^-2]
[[nodiscard]] BinChoice choose_bins(std::span<const std::int8_t> levels, const SurfaceMesh& mesh,
                                    const PatchHierarchy& patches, const GlossySides& glossy,
                                    std::span<const Spectrum> elements, double tolerance);

}  // namespace transillum
