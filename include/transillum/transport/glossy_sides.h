/// Which sides of the surface are glossy, and the finite elements they have (paper §2.1).
///
/// A glossy side has 4^bin_level rows of elements, one element a leaf in each: the mean radiance
/// that arrives from direction bin k [W sr^-1 m^-2]. What the side reflects of it towards any
/// direction follows from its projected BRDF. Sides without a lobe have none: their irradiance says
/// all.
#pragma once

#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/transport/projected_brdf.h>

#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

struct GlossySide {
    std::uint32_t root = 0;
    bool back = false;
    std::uint32_t brdf = 0;        ///< index into GlossySides::brdfs
    std::uint32_t projection = 0;  ///< index into GlossySides::projections
    std::int32_t bin_level = 0;
    std::uint32_t first_patch = 0, leaf_count = 0;
    std::uint64_t first_element = 0;

    [[nodiscard]] int bins() const { return bin_count(bin_level); }
    [[nodiscard]] std::uint64_t element(int bin, std::uint32_t patch) const {
        return first_element + static_cast<std::uint64_t>(bin) * leaf_count + patch - first_patch;
    }
};

struct GlossySides {
    static constexpr std::uint32_t none = 0xffffffffu;
    std::vector<Brdf> brdfs;                 ///< one a material
    std::vector<ProjectedBrdf> projections;  ///< one a glossy material and bin level
    std::vector<GlossySide> sides;
    std::vector<std::uint32_t> of_root_side;  ///< 2 * root + back -> index into sides, or none
    std::uint64_t element_count = 0;

    [[nodiscard]] bool empty() const { return sides.empty(); }
    /// Null for a side without a lobe.
    [[nodiscard]] const GlossySide* find(std::uint32_t root, bool back) const {
        const std::uint32_t i = of_root_side[2 * root + (back ? 1 : 0)];
        return i == none ? nullptr : &sides[i];
    }
};

struct BinOptions {
    int level =
        -1;  ///< of every glossy side, [0, max_bin_level]; -1: by the lobe's width and weight
};

/// Level at which bins resolve a lobe as far as the transport needs it.
[[nodiscard]] int bin_level_for(const Brdf& brdf);
/// Standard deviation of the lobe's directions about the mirrored one [radians], but for those that
/// the horizon cuts off.
[[nodiscard]] double lobe_width(const Brdf& brdf);
/// Bins of the deepest level are wider than the lobe: what they hold of it is blurred.
[[nodiscard]] bool is_sharper_than_bins(const Brdf& brdf);

/// Bin level of every root side (2 * root + back): -1 unless it reflects and its material has a
/// lobe. \throws UsageError for a level outside its range.
[[nodiscard]] std::vector<std::int8_t> choose_bin_levels(const SurfaceMesh& mesh,
                                                         const BinOptions& options);

[[nodiscard]] GlossySides lay_out_glossy_sides(const SurfaceMesh& mesh,
                                               const PatchHierarchy& patches,
                                               std::span<const std::int8_t> bin_levels);

}  // namespace transillum
