#include <transillum/base/error.h>
#include <transillum/solution/compare_solutions.h>

#include <fmt/format.h>

#include <cmath>

namespace transillum {

SolutionDifference compare_solutions(const Solution& a, const Solution& b) {
    if (a.scene_hash != b.scene_hash)
        throw InputError(
            "compare",
            fmt::format("solutions of different scenes (hash {} and {}); accepted: two bakes of "
                        "one scene with one --max-albedo and --sides",
                        a.scene_hash, b.scene_hash));
    if (a.patches.patch_count() != b.patches.patch_count())
        throw InputError("compare", fmt::format("{} and {} patches; accepted: the same subdivision",
                                                a.patches.patch_count(), b.patches.patch_count()));
    if (a.patches != b.patches)
        throw InputError("compare",
                         "as many patches, but other ones; accepted: the same "
                         "subdivision");
    SolutionDifference result;
    double area = 0.0, mean_a = 0.0, mean_b = 0.0, square = 0.0, largest = 0.0;
    for (std::uint32_t p = 0; p < a.patches.patch_count(); ++p) {
        if (!a.reflects(p) || (a.coverage[p] == 0.0f && b.coverage[p] == 0.0f)) continue;
        const double w = area_of_leaf(a.surface, a.patches, a.patches.leaf_of_patch(p));
        const double x =
            luminance(SpectrumSum(a.direct_irradiance[p]) + SpectrumSum(a.indirect_irradiance[p]));
        const double y =
            luminance(SpectrumSum(b.direct_irradiance[p]) + SpectrumSum(b.indirect_irradiance[p]));
        area += w;
        mean_a += w * x;
        mean_b += w * y;
        square += w * (x - y) * (x - y);
        largest = std::max(largest, std::abs(x - y));
        ++result.patches;
    }
    if (area == 0.0) return result;
    mean_a /= area;
    mean_b /= area;
    const double unit = mean_b > 0.0 ? mean_b : 1.0;  // against darkness: absolute
    result.bias = (mean_a - mean_b) / unit;
    result.relative_rmse = std::sqrt(square / area) / unit;
    result.largest = largest / unit;
    return result;
}

}  // namespace transillum
