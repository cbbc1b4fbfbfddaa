#include "render/glossy_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace transillum {

namespace {

/// Normals that lie no further apart have frames, and so bins, that are alike.
constexpr float least_cosine = 1.0f - 1e-6f;
constexpr std::uint64_t no_row = ~std::uint64_t{0};

/// From behind the horizon of a neighbour it is seen as from the horizon.
glm::vec3 above_horizon(glm::vec3 d) {
    if (d.z >= 0.0f) return d;
    d.z = 0.0f;
    const float length = glm::length(d);
    return length > 0.0f ? d / length : glm::vec3(1.0f, 0.0f, 0.0f);
}

/// Four sums side by side, as processors add. \pre n is 1 or a multiple of 4
float sum_of_products(const float* a, const float* b, int n) {
    if (n == 1) return a[0] * b[0];
    std::array<float, 4> sum{};
    for (int k = 0; k < n; k += 4)
        for (int j = 0; j < 4; ++j) sum[j] += a[k + j] * b[k + j];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// What all patches of a side have in common, for the few sides that meet at a leaf.
class SeenSides {
public:
    SeenSides(const Solution& solution, const std::vector<glm::mat3>& frames, const SurfacePoint& p)
        : solution_(solution), frames_(frames), p_(p), to_eye_(p.world_from_local * p.out) {}

    struct Seen {
        std::uint32_t side = GlossySides::none;
        Spectrum albedo{0.0f};
        std::array<float, bin_count(max_bin_level)> shares;
    };

    const Seen& at(std::uint32_t side) {
        for (const Seen& s : seen_)
            if (s.side == side) return s;
        Seen& s = seen_[next_++ % seen_.size()];
        s.side = side;
        const GlossySide& glossy = solution_.glossy.sides[side];
        const glm::vec3 out = above_horizon(to_eye_ * frames_[side]);
        s.albedo = lobe_albedo(p_.brdf, out.z);
        solution_.glossy.projections[glossy.projection].shares(
            out, std::span(s.shares).first(static_cast<std::size_t>(glossy.bins())));
        return s;
    }

private:
    const Solution& solution_;
    const std::vector<glm::mat3>& frames_;
    const SurfacePoint& p_;
    glm::vec3 to_eye_;
    std::array<Seen, 4> seen_;
    std::size_t next_ = 0;
};

}  // namespace

GlossyField::GlossyField(const Solution& solution, const VertexGrid* grid,
                         Interpolation interpolation)
    : solution_(&solution),
      grid_(grid),
      interpolation_(grid ? interpolation : Interpolation::none) {
    const std::vector<Facet> facets = facets_of(solution.surface);
    for (const GlossySide& side : solution.glossy.sides)
        frames_.emplace_back(bin_frame(facets[side.root].side_normal(side.back)));
    if (grid) stencils_ = VertexStencils(solution, *grid);
    take(solution.glossy_elements);
}

GlossyField GlossyField::with_elements(std::span<const Spectrum> elements) const {
    GlossyField other;
    other.solution_ = solution_;
    other.grid_ = grid_;
    other.interpolation_ = interpolation_;
    other.stencils_ = stencils_;
    other.frames_ = frames_;
    other.take(elements);
    return other;
}

void GlossyField::take(std::span<const Spectrum> elements) {
    bins_.resize(channel_count * elements.size());
    for (const GlossySide& side : solution_->glossy.sides) {
        const auto n = static_cast<std::uint64_t>(side.bins());
        for (std::uint64_t k = 0; k < n; ++k)
            for (std::uint64_t i = 0; i < side.leaf_count; ++i) {
                const Spectrum& bin = elements[side.first_element + k * side.leaf_count + i];
                float* const row = &bins_[channel_count * (side.first_element + i * n)];
                for (int c = 0; c < channel_count; ++c) row[c * n + k] = bin[c];
            }
    }
    if (grid_) combine_at_vertices();
}

bool GlossyField::is_plane(std::span<const VertexStencils::Entry> entries) const {
    return std::ranges::all_of(entries, [&](const VertexStencils::Entry& e) {
        const std::uint32_t first = entries.front().side;
        return solution_->glossy.sides[e.side].projection ==
                   solution_->glossy.sides[first].projection &&
               glm::dot(frames_[e.side][2], frames_[first][2]) > least_cosine;
    });
}

void GlossyField::combine_at_vertices() {
    vertex_row_.assign(2 * grid_->vertex_count(), no_row);
    for (std::uint32_t i = 0; i < vertex_row_.size(); ++i) {
        const auto entries = stencils_.at(i / 2, i % 2 != 0);
        if (entries.empty() || !is_plane(entries)) continue;
        vertex_row_[i] = vertex_bins_.size();
        const int n = channel_count * solution_->glossy.sides[entries.front().side].bins();
        vertex_bins_.resize(vertex_bins_.size() + n, 0.0f);
        float* const row = vertex_bins_.data() + vertex_row_[i];
        for (const VertexStencils::Entry& e : entries) {
            const float* const x = elements_of(e.patch, e.side).bins;
            for (int k = 0; k < n; ++k) row[k] += e.weight * x[k];
        }
    }
}

template <class Body>
Spectrum GlossyField::mean(const SurfacePoint& p, Body body) const {
    const auto own_side = static_cast<std::uint32_t>(p.side - solution_->glossy.sides.data());
    if (interpolation_ == Interpolation::none) return body(elements_of(p.patch, own_side));
    const bool back = p.patch != p.leaf;
    const auto fits = [&](std::uint32_t side) {
        return interpolation_ != Interpolation::planar || side == own_side ||
               glm::dot(frames_[side][2], frames_[own_side][2]) > least_cosine;
    };
    Spectrum sum(0.0f);
    for (int c = 0; c < 3; ++c) {
        const std::uint32_t vertex = grid_->leaf_vertices[p.leaf][c];
        const auto entries = stencils_.at(vertex, back);
        const std::uint64_t row = vertex_row_[2 * std::size_t{vertex} + (back ? 1 : 0)];
        if (row != no_row && fits(entries.front().side)) {
            sum += p.within[c] * body(Elements{entries.front().side, vertex_bins_.data() + row});
            continue;
        }
        Spectrum here(0.0f);
        float weight = 0.0f;
        for (const VertexStencils::Entry& e : entries) {
            if (!fits(e.side)) continue;
            here += e.weight * body(elements_of(e.patch, e.side));
            weight += e.weight;
        }
        sum += p.within[c] * (weight > 0.0f ? here / weight : body(elements_of(p.patch, own_side)));
    }
    return sum;
}

Spectrum GlossyField::reflected(const SurfacePoint& p) const {
    SeenSides sides(*solution_, frames_, p);
    return mean(p, [&](const Elements& elements) {
        const SeenSides::Seen& seen = sides.at(elements.side);
        const int n = solution_->glossy.sides[elements.side].bins();
        Spectrum sum;
        for (int c = 0; c < channel_count; ++c)
            sum[c] = sum_of_products(seen.shares.data(), elements.bins + c * n, n);
        return seen.albedo * sum;
    });
}

Spectrum GlossyField::incoming(const SurfacePoint& p, const glm::dvec3& from) const {
    std::uint32_t known = GlossySides::none;
    int bin = 0;
    return mean(p, [&](const Elements& elements) {
        if (elements.side != known) {
            known = elements.side;
            const glm::vec3 in = above_horizon(glm::vec3(from) * frames_[known]);
            bin = bin_at(square_of_direction(in), solution_->glossy.sides[known].bin_level);
        }
        const int n = solution_->glossy.sides[known].bins();
        Spectrum radiance;
        for (int c = 0; c < channel_count; ++c) radiance[c] = elements.bins[c * n + bin];
        return radiance;
    });
}

}  // namespace transillum
