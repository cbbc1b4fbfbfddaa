/// Light of the light samples at a point of a surface, as its BRDF reflects it (paper §4).
#pragma once

#include "render/surface_point.h"
#include "render/vertex_stencils.h"

#include <transillum/base/parallel.h>
#include <transillum/solution/solution.h>
#include <transillum/visibility/ray_tracer.h>

#include <cstdint>
#include <vector>

namespace transillum {

class DirectShader {
public:
    /// Keeps references.
    DirectShader(const Solution& solution, const RayTracer& rays);

    /// Lets `stored` be called for glossy sides. \param grid, stencils null: one value a patch
    void prepare_stored(const VertexGrid* grid, const VertexStencils* stencils,
                        const Workers& workers);

    /// Shadow rays decide which light samples are seen.
    [[nodiscard]] Spectrum traced(const SurfacePoint& p) const;
    /// The visibilities that the solution holds. \pre p has a side
    [[nodiscard]] Spectrum stored(const SurfacePoint& p) const;

private:
    [[nodiscard]] bool sees(const SurfacePoint& p, const LightSample& light) const;
    template <class Seen>
    [[nodiscard]] Spectrum sum_over_samples(const SurfacePoint& p, Seen seen) const;

    const Solution& solution_;
    const RayTracer& rays_;
    double beyond_ = 0.0;  ///< further than any two points of the surface are apart
    const VertexGrid* grid_ = nullptr;
    /// In 255ths, mean of the patches that touch a vertex and face the sample; rows of samples.
    std::vector<std::uint8_t> vertex_visibility_;
    std::vector<std::uint32_t> first_row_;  ///< 2 * vertex + back
};

}  // namespace transillum
