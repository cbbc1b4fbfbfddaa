/// Light that arrives at the Lambert parts of a solution's surface: per patch, or interpolated
/// (paper §6, Gouraud shading).
#pragma once

#include "render/surface_point.h"
#include "render/vertex_grid.h"

#include <transillum/base/parallel.h>
#include <transillum/solution/solution.h>

#include <array>
#include <span>
#include <vector>

namespace transillum {

/// What it holds. Direct light is held for sides without a lobe only: with one, it matters from
/// where it comes.
struct LambertParts {
    bool direct = true, finite_element = true;
};

class LambertField {
public:
    LambertField() = default;
    /// Keeps a reference to the grid. \param grid null: one value a patch
    LambertField(const Solution& solution, const VertexGrid* grid, LambertParts parts,
                 const Workers& workers);
    /// Of other finite elements than the solution's, one irradiance a patch and as glossy_sides.h
    /// lays them out; no direct light.
    LambertField(const Solution& solution, const VertexGrid* grid,
                 std::span<const Spectrum> irradiance, std::span<const Spectrum> glossy_elements,
                 const Workers& workers);

    /// Mean incoming radiance [W sr^-1 m^-2], weighted as the Lambert part reflects it.
    [[nodiscard]] Spectrum at(const SurfacePoint& p) const;

private:
    LambertField(const Solution& solution, const VertexGrid* grid);
    void add(const std::vector<Spectrum>& of_patches, const std::vector<float>& weights,
             const Workers& workers);

    const VertexGrid* grid_ = nullptr;
    std::vector<Spectrum> of_patches_;
    std::array<std::vector<Spectrum>, 2> of_vertices_;  ///< of the fronts, then of the backs
    std::uint32_t leaf_count_ = 0;
};

}  // namespace transillum
