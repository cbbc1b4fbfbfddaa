/// Images of what was baked, or is to be traced, in bands of wavelengths: one of each group, then
/// linear sRGB by the CIE curves (bands.h). Colours outside sRGB have negative channels.
#pragma once

#include <transillum/render/path_trace.h>
#include <transillum/render/render_solution.h>
#include <transillum/scene/measured_materials.h>
#include <transillum/solution/spectral_solution.h>

#include <list>
#include <vector>

namespace transillum {

/// A SolutionRenderer a group; of a solution in RGB there is but one, which makes what it makes
/// alone. Groups choose themselves where to spend samples.
class BandRenderer {
public:
    /// Needs the memory of as many solutions as there are groups. Keeps a reference to the workers.
    /// \throws as SolutionRenderer.
    BandRenderer(SpectralSolution spectral, const RenderOptions& options, const Workers& workers,
                 Monitor& monitor);

    /// \throws as SolutionRenderer::render.
    [[nodiscard]] Image render(const Camera& camera, const Workers& workers, Monitor& monitor);

private:
    int bands_;
    std::list<Solution> solutions_;  ///< where they are is where the renderers look for them
    std::vector<SolutionRenderer> renderers_;
};

/// One picture, group after group: needs the memory of one.
[[nodiscard]] Image render_bands(const SpectralSolution& spectral, const Camera& camera,
                                 const RenderOptions& options, const Workers& workers,
                                 Monitor& monitor);

/// As path_trace. Asked to stop, it returns what path_trace does, of every group.
/// \param surface of the scene; its own colours do not matter.
[[nodiscard]] Image path_trace_bands(SurfaceMesh surface, const Scene& scene,
                                     const SpectralOptions& spectral, const Camera& camera,
                                     const PathTraceOptions& options, const Workers& workers,
                                     Monitor& monitor);

}  // namespace transillum
