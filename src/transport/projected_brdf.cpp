#include "transport/projected_brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

/// Cells along an edge of the incoming square, and of the outgoing one that bins are summed from.
constexpr int cells = 32;

glm::vec3 centre_of_cell(int x, int y) {
    return direction_of_square((glm::vec2(x, y) + 0.5f) / static_cast<float>(cells));
}

}  // namespace

ProjectedBrdf::ProjectedBrdf(const Brdf& brdf, int bin_level)
    : level_(bin_level),
      table_(std::size_t{cells} * cells * bin_count(bin_level)),
      albedo_(bin_count(bin_level), Spectrum(0.0f)) {
    const int bins = bin_count(level_);
    const int cells_a_bin = cells * cells / bins;
    std::vector<glm::vec3> centre;
    std::vector<int> bin;
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x) {
            centre.push_back(centre_of_cell(x, y));
            bin.push_back(bin_at((glm::vec2(x, y) + 0.5f) / static_cast<float>(cells), level_));
            albedo_[bin.back()] +=
                transillum::lobe_albedo(brdf, centre.back().z) / static_cast<float>(cells_a_bin);
        }
    for (int in = 0; in < cells * cells; ++in) {
        float* const row = table_.data() + static_cast<std::size_t>(in) * bins;
        float sum = 0.0f;
        for (int out = 0; out < cells * cells; ++out) {
            const float f = mean_channel(evaluate_lobe(brdf, centre[in], centre[out]));
            row[bin[out]] += f / static_cast<float>(cells_a_bin);
            sum += f;
        }
        // A lobe narrower than the cells keeps its energy.
        if (!(sum > 0.0f)) {
            row[bin[cells * cells - 1 - in]] = 1.0f;  // the mirror direction's
            sum = static_cast<float>(cells_a_bin);
        }
        const float reflected = mean_channel(transillum::lobe_albedo(brdf, centre[in].z));
        const float summed = std::numbers::pi_v<float> / static_cast<float>(cells * cells) * sum;
        for (int j = 0; j < bins; ++j) row[j] *= reflected / summed;
    }
}

void ProjectedBrdf::lobe_into_bins(const glm::vec3& in, std::span<float> bins) const {
    const glm::vec2 at = glm::clamp(square_of_direction(in) * static_cast<float>(cells) - 0.5f,
                                    glm::vec2(0.0f), glm::vec2(static_cast<float>(cells) - 1.0f));
    const int x = std::min(static_cast<int>(at.x), cells - 2);
    const int y = std::min(static_cast<int>(at.y), cells - 2);
    const glm::vec2 t = at - glm::vec2(x, y);
    const std::size_t n = bins.size();
    const float* const row = table_.data() + (static_cast<std::size_t>(y) * cells + x) * n;
    for (std::size_t j = 0; j < n; ++j)
        bins[j] = glm::mix(glm::mix(row[j], row[n + j], t.x),
                           glm::mix(row[cells * n + j], row[(cells + 1) * n + j], t.x), t.y);
}

}  // namespace transillum
