#include "render/lambert_field.h"

#include "render/patch_areas.h"

#include <algorithm>
#include <numbers>
#include <span>

namespace transillum {

namespace {

constexpr float inv_pi = std::numbers::inv_pi_v<float>;

std::vector<Spectrum> direct_light(const Solution& s) {
    std::vector<Spectrum> values = s.direct_irradiance;
    for (Spectrum& v : values) v *= inv_pi;
    for (const GlossySide& side : s.glossy.sides)
        std::fill_n(values.begin() + side.first_patch, side.leaf_count, Spectrum(0.0f));
    return values;
}

/// Of a glossy side, what its bins hold, weighted with the Lambert part's coupling to them.
std::vector<Spectrum> indirect_light(const Solution& s, std::span<const Spectrum> irradiance,
                                     std::span<const Spectrum> glossy_elements) {
    std::vector<Spectrum> values(irradiance.begin(), irradiance.end());
    for (Spectrum& v : values) v *= inv_pi;
    for (const GlossySide& side : s.glossy.sides) {
        const ProjectedBrdf& projected = s.glossy.projections[side.projection];
        const auto first = values.begin() + side.first_patch;
        std::fill_n(first, side.leaf_count, Spectrum(0.0f));
        float whole = 0.0f;
        for (int k = 0; k < side.bins(); ++k) whole += projected.coupling(k);
        if (!(whole > 0.0f)) continue;
        for (int k = 0; k < side.bins(); ++k) {
            const Spectrum* const bins = &glossy_elements[side.element(k, side.first_patch)];
            for (std::uint32_t i = 0; i < side.leaf_count; ++i)
                first[i] += projected.coupling(k) / whole * bins[i];
        }
    }
    return values;
}

}  // namespace

LambertField::LambertField(const Solution& solution, const VertexGrid* grid)
    : grid_(grid), leaf_count_(solution.patches.leaf_count) {
    const std::size_t patches = solution.patches.patch_count();
    if (grid_)
        of_vertices_.fill(std::vector<Spectrum>(grid_->vertex_count(), Spectrum(0.0f)));
    else
        of_patches_.assign(patches, Spectrum(0.0f));
}

LambertField::LambertField(const Solution& solution, const VertexGrid* grid, LambertParts parts,
                           const Workers& workers)
    : LambertField(solution, grid) {
    if (parts.finite_element)
        add(indirect_light(solution, solution.indirect_irradiance, solution.glossy_elements),
            solution.coverage, workers);
    if (parts.direct) add(direct_light(solution), patch_areas(solution), workers);
}

LambertField::LambertField(const Solution& solution, const VertexGrid* grid,
                           std::span<const Spectrum> irradiance,
                           std::span<const Spectrum> glossy_elements, const Workers& workers)
    : LambertField(solution, grid) {
    add(indirect_light(solution, irradiance, glossy_elements), solution.coverage, workers);
}

void LambertField::add(const std::vector<Spectrum>& of_patches, const std::vector<float>& weights,
                       const Workers& workers) {
    const auto add_to = [](std::vector<Spectrum>& sum, const std::vector<Spectrum>& values) {
        std::ranges::transform(sum, values, sum.begin(), std::plus());
    };
    if (!grid_) return add_to(of_patches_, of_patches);
    const std::span<const Spectrum> values(of_patches);
    const std::span<const float> w(weights);
    add_to(of_vertices_[0],
           vertex_values(*grid_, values.first(leaf_count_), w.first(leaf_count_), workers));
    add_to(of_vertices_[1],
           vertex_values(*grid_, values.last(leaf_count_), w.last(leaf_count_), workers));
}

Spectrum LambertField::at(const SurfacePoint& p) const {
    if (!grid_) return of_patches_[p.patch];
    const std::vector<Spectrum>& values = of_vertices_[p.patch == p.leaf ? 0 : 1];
    const auto& v = grid_->leaf_vertices[p.leaf];
    return p.within.x * values[v[0]] + p.within.y * values[v[1]] + p.within.z * values[v[2]];
}

}  // namespace transillum
