#include <transillum/transport/choose_bins.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace transillum {

namespace {

/// Directions that must meet a bin, in the mean.
constexpr std::uint64_t least_directions = 8;
/// Outgoing directions along an edge of the square, of equal projected solid angle.
constexpr int tried = 6;

/// What bins contribute to the radiance towards some directions: of the deeper ones, less what each
/// contributes to the mean of its four.
class Contrast {
public:
    Contrast(const Brdf& brdf, int level)
        : bins_(static_cast<std::size_t>(bin_count(level + 1))), weights_(bins_ * tried * tried) {
        const ProjectedBrdf fine(brdf, level + 1), coarse(brdf, level);
        std::array<float, bin_count(max_bin_level)> of_fine, of_coarse;
        for (int out = 0; out < tried * tried; ++out) {
            const glm::vec3 direction = direction_of_square(
                (glm::vec2(out % tried, out / tried) + 0.5f) / static_cast<float>(tried));
            fine.shares(direction, std::span(of_fine).first(bins_));
            coarse.shares(direction, std::span(of_coarse).first(bins_ / 4));
            const float albedo = mean_channel(lobe_albedo(brdf, direction.z));
            const int edge = 1 << (level + 1);
            for (std::size_t k = 0; k < bins_; ++k) {
                const auto y = static_cast<int>(k) / edge, x = static_cast<int>(k) % edge;
                const float mean = of_coarse[static_cast<std::size_t>(y / 2 * (edge / 2) + x / 2)];
                weights_[static_cast<std::size_t>(out) * bins_ + k] =
                    albedo * (of_fine[k] - 0.25f * mean);
            }
        }
    }

    /// Mean square over the directions. \param luminances of the bins
    [[nodiscard]] double mean_square(std::span<const float> luminances) const {
        double sum = 0.0;
        for (std::size_t out = 0; out < tried * tried; ++out) {
            double difference = 0.0;
            for (std::size_t k = 0; k < bins_; ++k)
                difference += double{weights_[out * bins_ + k]} * luminances[k];
            sum += difference * difference;
        }
        return sum / (tried * tried);
    }

private:
    std::size_t bins_;
    std::vector<float> weights_;  ///< direction by direction
};

double mean_square_over(const GlossySide& side, const SurfaceMesh& mesh,
                        const PatchHierarchy& patches, std::span<const Spectrum> elements,
                        const Contrast& contrast) {
    double sum = 0.0, area = 0.0;
    std::array<float, bin_count(max_bin_level)> luminances;
    const auto bins = static_cast<std::size_t>(side.bins());
    for (std::uint32_t p = side.first_patch; p < side.first_patch + side.leaf_count; ++p) {
        for (std::size_t k = 0; k < bins; ++k)
            luminances[k] = luminance(elements[side.element(static_cast<int>(k), p)]);
        const double a = area_of_leaf(mesh, patches, patches.leaf_of_patch(p));
        sum += a * contrast.mean_square(std::span(luminances).first(bins));
        area += a;
    }
    return sum / area;
}

}  // namespace

std::vector<std::int8_t> deeper_bins(std::span<const std::int8_t> levels,
                                     std::uint64_t directions) {
    std::vector<std::int8_t> deeper(levels.begin(), levels.end());
    for (std::int8_t& level : deeper) {
        const int next = level + 1;
        const bool is_met =
            static_cast<std::uint64_t>(bin_count(next)) * least_directions <= directions;
        if (level >= 0 && next <= max_bin_level && is_met) level = static_cast<std::int8_t>(next);
    }
    return deeper;
}

BinChoice choose_bins(std::span<const std::int8_t> levels, const SurfaceMesh& mesh,
                      const PatchHierarchy& patches, const GlossySides& glossy,
                      std::span<const Spectrum> elements, double tolerance) {
    BinChoice choice{{levels.begin(), levels.end()}};
    std::map<std::pair<std::uint32_t, int>, Contrast> contrasts;  // by material and level
    for (const GlossySide& side : glossy.sides) {
        std::int8_t& level = choice.levels[2 * side.root + (side.back ? 1 : 0)];
        if (side.bin_level != level + 1) continue;
        const Contrast& contrast =
            contrasts.try_emplace({side.brdf, level}, glossy.brdfs[side.brdf], level).first->second;
        const double square = mean_square_over(side, mesh, patches, elements, contrast);
        if (!(std::sqrt(square) > tolerance)) continue;
        ++level;
        ++choice.divided;
    }
    return choice;
}

}  // namespace transillum
