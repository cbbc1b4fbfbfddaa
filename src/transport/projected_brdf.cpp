#include <transillum/transport/projected_brdf.h>

#include <algorithm>
#include <numeric>

namespace transillum {

namespace {

/// Cells along an edge of the outgoing square, and of the incoming one that bins are summed from.
constexpr int cells = 32;
/// Bins with a smaller share than this of the largest are left out.
constexpr float least_share = 1e-4f;

glm::vec2 centre_of_cell(int x, int y) {
    return (glm::vec2(x, y) + 0.5f) / static_cast<float>(cells);
}

void normalise(std::span<float> shares) {
    const float least = least_share * *std::ranges::max_element(shares);
    for (float& s : shares) s = s < least ? 0.0f : s;
    const float sum = std::accumulate(shares.begin(), shares.end(), 0.0f);
    for (float& s : shares) s /= sum;
}

}  // namespace

ProjectedBrdf::ProjectedBrdf(const Brdf& brdf, int bin_level)
    : level_(bin_level),
      table_(std::size_t{cells} * cells * bin_count(bin_level)),
      lobe_albedo_(bin_count(bin_level), Spectrum(0.0f)),
      coupling_(bin_count(bin_level), 0.0f) {
    const auto bins = static_cast<std::size_t>(bin_count(level_));
    const auto share = static_cast<float>(bins) / static_cast<float>(cells * cells);
    std::vector<glm::vec3> centre;
    std::vector<int> bin;
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x) {
            const glm::vec2 square = centre_of_cell(x, y);
            centre.push_back(direction_of_square(square));
            bin.push_back(bin_at(square, level_));
            lobe_albedo_[bin.back()] += share * transillum::lobe_albedo(brdf, centre.back().z);
            coupling_[bin.back()] += share * diffuse_coupling(brdf, centre.back().z);
        }
    for (int out = 0; out < cells * cells; ++out) {
        const std::span<float> row(table_.data() + static_cast<std::size_t>(out) * bins, bins);
        for (int in = 0; in < cells * cells; ++in)
            row[bin[in]] += mean_channel(evaluate_lobe(brdf, centre[in], centre[out]));
        // A lobe that falls between the cells lies where a mirror would send it.
        if (!(*std::ranges::max_element(row) > 0.0f)) row[bin[cells * cells - 1 - out]] = 1.0f;
        normalise(row);
    }
}

void ProjectedBrdf::shares(const glm::vec3& out, std::span<float> shares) const {
    const glm::vec2 at = glm::clamp(square_of_direction(out) * static_cast<float>(cells) - 0.5f,
                                    glm::vec2(0.0f), glm::vec2(static_cast<float>(cells) - 1.0f));
    const int x = std::min(static_cast<int>(at.x), cells - 2);
    const int y = std::min(static_cast<int>(at.y), cells - 2);
    const glm::vec2 t = at - glm::vec2(x, y);
    const std::size_t n = shares.size();
    const float* const row = table_.data() + (static_cast<std::size_t>(y) * cells + x) * n;
    for (std::size_t k = 0; k < n; ++k)
        shares[k] = glm::mix(glm::mix(row[k], row[n + k], t.x),
                             glm::mix(row[cells * n + k], row[(cells + 1) * n + k], t.x), t.y);
}

}  // namespace transillum
