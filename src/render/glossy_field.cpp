#include "render/glossy_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace transillum {

namespace {

/// Normals that lie no further apart have frames, and so bins, that are alike.
constexpr float least_cosine = 1.0f - 1e-6f;

/// From behind the horizon of a neighbour it is seen as from the horizon.
glm::vec3 above_horizon(glm::vec3 d) {
    if (d.z >= 0.0f) return d;
    d.z = 0.0f;
    const float length = glm::length(d);
    return length > 0.0f ? d / length : glm::vec3(1.0f, 0.0f, 0.0f);
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
      interpolation_(grid ? interpolation : Interpolation::none),
      bins_(solution.glossy_elements.size()) {
    if (grid) stencils_ = VertexStencils(solution, *grid);
    const std::vector<Facet> facets = facets_of(solution.surface);
    for (const GlossySide& side : solution.glossy.sides) {
        frames_.emplace_back(bin_frame(facets[side.root].side_normal(side.back)));
        const auto n = static_cast<std::uint64_t>(side.bins());
        for (std::uint64_t k = 0; k < n; ++k)
            for (std::uint64_t i = 0; i < side.leaf_count; ++i)
                bins_[side.first_element + i * n + k] = glm::vec4(
                    solution.glossy_elements[side.first_element + k * side.leaf_count + i], 0.0f);
    }
}

template <class Body>
Spectrum GlossyField::mean(const SurfacePoint& p, Body body) const {
    const auto own_side = static_cast<std::uint32_t>(p.side - solution_->glossy.sides.data());
    const VertexStencils::Entry own{p.patch, own_side, 1.0f};
    if (interpolation_ == Interpolation::none) return body(own);
    const bool back = p.patch != p.leaf;
    const glm::vec3 normal = frames_[own_side][2];
    Spectrum sum(0.0f);
    for (int c = 0; c < 3; ++c) {
        Spectrum here(0.0f);
        float weight = 0.0f;
        for (const VertexStencils::Entry& e : stencils_.at(grid_->leaf_vertices[p.leaf][c], back)) {
            if (interpolation_ == Interpolation::planar && e.side != own_side &&
                !(glm::dot(frames_[e.side][2], normal) > least_cosine))
                continue;
            here += e.weight * body(e);
            weight += e.weight;
        }
        sum += p.within[c] * (weight > 0.0f ? here / weight : body(own));
    }
    return glm::max(sum, Spectrum(0.0f));
}

Spectrum GlossyField::reflected(const SurfacePoint& p) const {
    SeenSides sides(*solution_, frames_, p);
    return mean(p, [&](const VertexStencils::Entry& e) {
        const SeenSides::Seen& seen = sides.at(e.side);
        const glm::vec4* const x = bins_of(e);
        const int n = solution_->glossy.sides[e.side].bins();
        glm::vec4 sum(0.0f);
        for (int k = 0; k < n; ++k) sum += seen.shares[k] * x[k];
        return seen.albedo * Spectrum(sum);
    });
}

Spectrum GlossyField::incoming(const SurfacePoint& p, const glm::dvec3& from) const {
    std::uint32_t known = GlossySides::none;
    int bin = 0;
    return mean(p, [&](const VertexStencils::Entry& e) {
        if (e.side != known) {
            known = e.side;
            const glm::vec3 in = above_horizon(glm::vec3(from) * frames_[e.side]);
            bin = bin_at(square_of_direction(in), solution_->glossy.sides[e.side].bin_level);
        }
        return Spectrum(bins_of(e)[bin]);
    });
}

}  // namespace transillum
