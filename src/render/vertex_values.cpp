#include "render/vertex_grid.h"

#include <transillum/base/sampling.h>

#include <glm/geometric.hpp>

#include <algorithm>

namespace transillum {

namespace {

/// Vertices inside a regular grid touch six leaves; those at borders fewer, too few for a gradient.
constexpr std::size_t enough_leaves = 6;
/// Leaves without weight have a say only where no other has.
constexpr float least_weight = 1e-6f;

struct WeightedMean {
    double weight = 0.0;
    SpectrumSum value{0.0};
    glm::dvec3 centre{0.0};
};

class VertexFit {
public:
    VertexFit(const VertexGrid& grid, std::span<const Spectrum> values,
              std::span<const float> weights)
        : grid_(grid), values_(values), weights_(weights) {}

    [[nodiscard]] Spectrum value_at(std::uint32_t vertex) {
        const auto touching = grid_.leaves_at(vertex);
        gather_surroundings(touching);
        const WeightedMean near = mean_over(touching);
        const SpectrumSum moved = near.value + gradient_step(grid_.positions[vertex] - near.centre);
        return Spectrum(glm::max(moved, SpectrumSum(0.0)));
    }

private:
    void gather_surroundings(std::span<const std::uint32_t> touching) {
        around_.assign(touching.begin(), touching.end());
        if (touching.size() >= enough_leaves) return;
        for (const std::uint32_t leaf : touching)
            for (const std::uint32_t v : grid_.leaf_vertices[leaf]) {
                const auto more = grid_.leaves_at(v);
                around_.insert(around_.end(), more.begin(), more.end());
            }
        std::sort(around_.begin(), around_.end());
        around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
    }

    [[nodiscard]] double weight(std::uint32_t leaf) const {
        return std::max(weights_[leaf], least_weight);
    }

    [[nodiscard]] WeightedMean mean_over(std::span<const std::uint32_t> leaves) const {
        WeightedMean m;
        for (const std::uint32_t leaf : leaves) {
            const double w = weight(leaf);
            m.weight += w;
            m.value += w * SpectrumSum(values_[leaf]);
            m.centre += w * grid_.leaf_centres[leaf];
        }
        m.value /= m.weight;
        m.centre /= m.weight;
        return m;
    }

    /// Change of the fitted linear function along a step: weighted least squares in the tangent
    /// plane, shrunk by the adjusted coefficient of determination and to the range of the
    /// surroundings.
    [[nodiscard]] SpectrumSum gradient_step(const glm::dvec3& step) const {
        const WeightedMean mean = mean_over(around_);
        glm::dvec3 normal(0.0);
        for (const std::uint32_t leaf : around_) normal += grid_.leaf_normals[leaf];
        if (!(glm::length(normal) > 0.0)) return SpectrumSum(0.0);
        const glm::dmat3 frame = frame_about(glm::normalize(normal));

        double xx = 0.0, xy = 0.0, yy = 0.0;
        SpectrumSum xf(0.0), yf(0.0), ff(0.0), low(mean.value), high(mean.value);
        const auto count = static_cast<double>(around_.size());
        for (const std::uint32_t leaf : around_) {
            const double w = weight(leaf);
            const glm::dvec3 q = grid_.leaf_centres[leaf] - mean.centre;
            const double x = glm::dot(frame[0], q), y = glm::dot(frame[1], q);
            const SpectrumSum value(values_[leaf]), f = value - mean.value;
            xx += w * x * x;
            xy += w * x * y;
            yy += w * y * y;
            xf += w * x * f;
            yf += w * y * f;
            ff += w * f * f;
            low = glm::min(low, value);
            high = glm::max(high, value);
        }
        const double determinant = xx * yy - xy * xy;
        if (count < 4.0 || !(determinant > 1e-6 * (xx + yy) * (xx + yy))) return SpectrumSum(0.0);
        const SpectrumSum gx = (yy * xf - xy * yf) / determinant,
                          gy = (xx * yf - xy * xf) / determinant;
        const SpectrumSum change = gx * glm::dot(frame[0], step) + gy * glm::dot(frame[1], step);
        const SpectrumSum unexplained = (ff - gx * xf - gy * yf) / (count - 3.0);
        SpectrumSum result(0.0);
        for (int c = 0; c < channel_count; ++c) {
            if (!(ff[c] > 0.0)) continue;
            const double trust =
                std::clamp(1.0 - unexplained[c] / (ff[c] / (count - 1.0)), 0.0, 1.0);
            result[c] = std::clamp(trust * change[c], low[c] - high[c], high[c] - low[c]);
        }
        return result;
    }

    const VertexGrid& grid_;
    std::span<const Spectrum> values_;
    std::span<const float> weights_;
    std::vector<std::uint32_t> around_;
};

}  // namespace

std::vector<Spectrum> vertex_values(const VertexGrid& grid, std::span<const Spectrum> values,
                                    std::span<const float> weights, const Workers& workers) {
    std::vector<Spectrum> result(grid.vertex_count());
    workers.for_ranges(result.size(), 1024, [&](std::size_t from, std::size_t to, int) {
        VertexFit fit(grid, values, weights);
        for (std::size_t v = from; v < to; ++v)
            result[v] = fit.value_at(static_cast<std::uint32_t>(v));
    });
    for (const VertexGrid::Hanging& h : grid.hanging)
        result[h.vertex] = glm::mix(result[h.from], result[h.to], h.share);
    return result;
}

}  // namespace transillum
