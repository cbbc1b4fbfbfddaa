#include <transillum/base/error.h>
#include <transillum/transport/glossy_sides.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace transillum {

namespace {

/// Exponent of the max-Phong lobe as wide as the lobe.
float equivalent_shininess(const Brdf& brdf) {
    return brdf.lobe == Lobe::ggx ? 2.0f / (brdf.alpha * brdf.alpha) - 2.0f : brdf.shininess;
}

/// A bin of the deepest level is about 22 degrees wide, as the lobe of this exponent is.
constexpr float sharpest_shininess = 40.0f;
/// Lobes that reflect less in every channel need one level less.
constexpr float weak_lobe = 0.1f;

}  // namespace

int bin_level_for(const Brdf& brdf) {
    // Half widths of 60, 37 and 14 degrees against bins 90, 45 and 22 wide.
    constexpr std::array<float, max_bin_level> least_shininess{1.0f, 3.0f, 24.0f};
    int level = 0;
    while (level < max_bin_level && equivalent_shininess(brdf) >= least_shininess[level]) ++level;
    const bool weak = max_channel(lobe_albedo(brdf, 0.7f)) < weak_lobe;
    return weak && level > 0 ? level - 1 : level;
}

double lobe_width(const Brdf& brdf) {
    return 1.0 / std::sqrt(std::max(1.0, double{equivalent_shininess(brdf)}));
}

bool is_sharper_than_bins(const Brdf& brdf) {
    return brdf.lobe != Lobe::none && equivalent_shininess(brdf) > sharpest_shininess;
}

std::vector<std::int8_t> choose_bin_levels(const SurfaceMesh& mesh, const BinOptions& options) {
    if (options.level < -1 || options.level > max_bin_level)
        throw UsageError("bin level " + std::to_string(options.level) + "; accepted: 0 to " +
                         std::to_string(max_bin_level) + ", or -1 (automatic)");
    std::vector<std::int8_t> of_material;
    for (const Material& m : mesh.materials) {
        const Brdf brdf = brdf_of(m);
        const int level = options.level >= 0 ? options.level : bin_level_for(brdf);
        of_material.push_back(static_cast<std::int8_t>(brdf.lobe == Lobe::none ? -1 : level));
    }
    std::vector<std::int8_t> levels;
    for (const RootTriangle& t : mesh.triangles) {
        levels.push_back(of_material[t.material]);
        levels.push_back(mesh.materials[t.material].back_reflects ? levels.back() : -1);
    }
    return levels;
}

GlossySides lay_out_glossy_sides(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                 std::span<const std::int8_t> bin_levels) {
    GlossySides glossy;
    for (const Material& m : mesh.materials) glossy.brdfs.push_back(brdf_of(m));
    glossy.of_root_side.assign(bin_levels.size(), GlossySides::none);
    std::map<std::pair<std::uint32_t, int>, std::uint32_t> known;
    for (const std::uint32_t back : {0u, 1u})
        for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r) {
            const int level = bin_levels[2 * r + back];
            if (level < 0) continue;
            const std::uint32_t m = mesh.triangles[r].material;
            const auto [at, is_new] = known.try_emplace(
                {m, level}, static_cast<std::uint32_t>(glossy.projections.size()));
            if (is_new) glossy.projections.emplace_back(glossy.brdfs[m], level);
            GlossySide side{r, back == 1, m, at->second, level};
            side.first_patch = patches.roots[r].first_leaf + (back ? patches.leaf_count : 0);
            side.leaf_count = patches.leaves_of(r);
            side.first_element = glossy.element_count;
            glossy.element_count += static_cast<std::uint64_t>(side.bins()) * side.leaf_count;
            glossy.of_root_side[2 * r + back] = static_cast<std::uint32_t>(glossy.sides.size());
            glossy.sides.push_back(side);
        }
    return glossy;
}

}  // namespace transillum
