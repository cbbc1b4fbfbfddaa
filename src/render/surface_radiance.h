/// What the patches of a solution, or the vertices between them, shine with towards the mean of all
/// directions: interpolated as pictures do.
#pragma once

#include "render/vertex_grid.h"

#include <transillum/base/parallel.h>
#include <transillum/render/render_solution.h>
#include <transillum/solution/spectral_solution.h>

#include <vector>

namespace transillum {

/// [W sr^-1 m^-2], as sRGB where there are bands. One a vertex of the grid as seen from the front,
/// then as seen from the back. \param grid null: one a patch. \param components monte_carlo has no
/// say
[[nodiscard]] std::vector<Spectrum> surface_radiance(const SpectralSolution& spectral,
                                                     const VertexGrid* grid,
                                                     const Components& components,
                                                     const Workers& workers);

}  // namespace transillum
