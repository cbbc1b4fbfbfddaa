/// What a solution looks like from anywhere, as vertex colours: interpolated as pictures do
/// (paper §6), and of glossy lobes the mean over outgoing directions. The Monte-Carlo component
/// depends on the view and is left out.
#pragma once

#include <transillum/base/parallel.h>
#include <transillum/render/image.h>
#include <transillum/render/render_solution.h>
#include <transillum/solution/radiance_mesh.h>
#include <transillum/solution/spectral_solution.h>

namespace transillum {

struct RadianceMeshOptions {
    Components components;    ///< monte_carlo has no say
    bool interpolate = true;  ///< else one radiance a patch, whose vertices are its own
    ToneMapping tone;         ///< automatic: by the median of the vertices
};

/// Of the sides of root triangles that shine, front and back each by themselves: what no light
/// reaches is left out. Neighbours of other size meet in vertices at the same place, within a
/// smooth surface in common ones. Does not depend on the number of threads.
[[nodiscard]] RadianceMesh make_radiance_mesh(const SpectralSolution& spectral,
                                              const RadianceMeshOptions& options,
                                              const Workers& workers);

}  // namespace transillum
