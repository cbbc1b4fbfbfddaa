#include "render/lightmap/fill_chart.h"

#include "render/surface_at.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace transillum {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Barycentric coordinates of the point of a triangle nearest to p.
glm::dvec2 nearest(const std::array<glm::dvec2, 3>& t, const glm::dvec2& p) {
    const double whole = cross(t[1] - t[0], t[2] - t[0]);
    if (whole != 0.0) {
        const glm::dvec2 b(cross(p - t[0], t[2] - t[0]) / whole,
                           cross(t[1] - t[0], p - t[0]) / whole);
        if (b.x >= 0.0 && b.y >= 0.0 && b.x + b.y <= 1.0) return b;
    }
    constexpr std::array<glm::dvec2, 3> corners{glm::dvec2(0, 0), glm::dvec2(1, 0),
                                                glm::dvec2(0, 1)};
    double least = std::numeric_limits<double>::infinity();
    glm::dvec2 best(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 from = t[i], edge = t[(i + 1) % 3] - from;
        const double length2 = glm::dot(edge, edge);
        const double share =
            length2 > 0.0 ? std::clamp(glm::dot(p - from, edge) / length2, 0.0, 1.0) : 0.0;
        const glm::dvec2 away = p - (from + share * edge);
        if (glm::dot(away, away) >= least) continue;
        least = glm::dot(away, away);
        best = corners[i] + share * (corners[(i + 1) % 3] - corners[i]);
    }
    return best;
}

glm::dvec2 place(const std::array<glm::dvec2, 3>& t, const glm::dvec2& b) {
    return t[0] + b.x * (t[1] - t[0]) + b.y * (t[2] - t[0]);
}

class ChartTexels {
public:
    ChartTexels(const Chart& chart, const RadianceField& field) : chart_(chart), field_(field) {}

    void sample() {
        const auto count = static_cast<std::size_t>(chart_.width) * chart_.height;
        std::vector<double> distance2(count, std::numeric_limits<double>::infinity());
        std::vector<const Chart::Triangle*> triangles(count, nullptr);
        std::vector<glm::dvec2> points(count);
        for (const Chart::Triangle& t : chart_.triangles) {
            const auto& [a, b, c] = t.corners;
            const glm::dvec2 low = glm::min(glm::min(a, b), c) - double(Chart::padding);
            const glm::dvec2 high = glm::max(glm::max(a, b), c) + double(Chart::padding);
            const int right = std::min(chart_.width, static_cast<int>(std::ceil(high.x)));
            const int bottom = std::min(chart_.height, static_cast<int>(std::ceil(high.y)));
            for (int y = std::max(0, static_cast<int>(low.y)); y < bottom; ++y)
                for (int x = std::max(0, static_cast<int>(low.x)); x < right; ++x) {
                    const std::size_t i = index(x, y);
                    if (distance2[i] == 0.0) continue;
                    const glm::dvec2 middle(x + 0.5, y + 0.5);
                    const glm::dvec2 point = nearest(t.corners, middle);
                    const glm::dvec2 away = middle - place(t.corners, point);
                    // Within it the way back and forth is rounded.
                    const double d2 = glm::dot(away, away) < 1e-18 ? 0.0 : glm::dot(away, away);
                    if (d2 >= distance2[i]) continue;
                    distance2[i] = d2;
                    triangles[i] = &t;
                    points[i] = point;
                }
        }
        values_.assign(count, Spectrum(0.0f));
        emits_.assign(count, 0.0f);
        for (std::size_t i = 0; i < count; ++i) {
            if (!triangles[i]) continue;
            values_[i] = field_.at(triangles[i]->side, points[i]);
            emits_[i] = field_.emits(triangles[i]->side) ? 1.0f : 0.0f;
        }
    }

    /// Kaczmarz's method: each sample along a border in turn moves the texels it is filtered from,
    /// as little as gives its value. It converges from where the texels are, and needs no matrix.
    void stitch() {
        constexpr int sweeps = 16;
        const std::vector<Sample> samples = border_samples();
        for (int sweep = 0; sweep < sweeps; ++sweep)
            for (const Sample& s : samples) {
                Spectrum missing = s.value;
                float norm = 0.0f;
                for (std::size_t k = 0; k < 4; ++k) {
                    missing -= s.weights[k] * values_[s.texels[k]];
                    norm += s.weights[k] * s.weights[k];
                }
                for (std::size_t k = 0; k < 4; ++k)
                    values_[s.texels[k]] += (s.weights[k] / norm) * missing;
            }
        for (Spectrum& value : values_) value = glm::max(value, Spectrum(0.0f));
    }

    void write(Image& lightmap) const {
        for (int y = 0; y < chart_.height; ++y)
            for (int x = 0; x < chart_.width; ++x) {
                lightmap.at(chart_.x + x, chart_.y + y) = values_[index(x, y)];
                lightmap.emitter_mask[static_cast<std::size_t>(chart_.y + y) * lightmap.width +
                                      chart_.x + x] = emits_[index(x, y)];
            }
    }

private:
    /// A point, and the four texels that linear filtering makes it of.
    struct Sample {
        std::array<std::uint32_t, 4> texels;
        std::array<float, 4> weights;
        Spectrum value;
    };

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * chart_.width + x;
    }

    [[nodiscard]] std::vector<Sample> border_samples() const {
        constexpr std::array<glm::dvec2, 3> corners{glm::dvec2(0, 0), glm::dvec2(1, 0),
                                                    glm::dvec2(0, 1)};
        std::vector<Sample> samples;
        for (const ChartBorder& border : borders_of(chart_, field_.solution.surface)) {
            const Chart::Triangle& t = chart_.triangles[border.triangle];
            const auto from = static_cast<std::size_t>(border.corner), to = (from + 1) % 3;
            const int pieces =
                1 + static_cast<int>(2.0 * glm::distance(t.corners[from], t.corners[to]));
            for (int i = 0; i <= pieces; ++i) {
                const double share = double(i) / pieces;
                const glm::dvec2 b = corners[from] + share * (corners[to] - corners[from]);
                samples.push_back(sample(place(t.corners, b), field_.at(t.side, b)));
            }
        }
        return samples;
    }

    [[nodiscard]] Sample sample(const glm::dvec2& p, const Spectrum& value) const {
        const glm::dvec2 low = glm::floor(p - 0.5);
        const glm::vec2 share(p - 0.5 - low);
        const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
        Sample s{{}, {}, value};
        for (int k = 0; k < 4; ++k) {
            const int right = k % 2, down = k / 2;
            s.texels[k] = static_cast<std::uint32_t>(index(x + right, y + down));
            s.weights[k] = (right ? share.x : 1.0f - share.x) * (down ? share.y : 1.0f - share.y);
        }
        return s;
    }

    const Chart& chart_;
    const RadianceField& field_;
    std::vector<Spectrum> values_;
    std::vector<float> emits_;
};

}  // namespace

Spectrum RadianceField::at(const RootSide& side, const glm::dvec2& b) const {
    const PatchHierarchy& patches = solution.patches;
    Hit hit;
    hit.b1 = static_cast<float>(b.x);
    hit.b2 = static_cast<float>(b.y);
    const std::uint32_t leaf = patches.leaf_at(side.root, hit.b1, hit.b2);
    const glm::vec3 within = within_leaf(patches, leaf, hit);
    const std::size_t first = side.back ? grid.vertex_count() : 0;
    Spectrum result(0.0f);
    for (int i = 0; i < 3; ++i)
        result += within[i] * values[first + grid.leaf_vertices[leaf][static_cast<std::size_t>(i)]];
    return result;
}

bool RadianceField::emits(const RootSide& side) const {
    const PatchHierarchy& patches = solution.patches;
    return solution.emits(patches.roots[side.root].first_leaf +
                          (side.back ? patches.leaf_count : 0u));
}

void fill_chart(const Chart& chart, const RadianceField& field, Image& lightmap) {
    ChartTexels texels(chart, field);
    texels.sample();
    texels.stitch();
    texels.write(lightmap);
}

}  // namespace transillum
