/// What an eye ray sees of a solution: emission + direct + finite-element radiance.
#pragma once

#include "render/facets.h"
#include "render/vertex_grid.h"

#include <transillum/render/render_solution.h>
#include <transillum/visibility/ray_tracer.h>

namespace transillum {

struct Sight {
    Spectrum radiance{0.0f};
    bool emits = false;  ///< the side seen is an emitter's
};

class SolutionShader {
public:
    /// Keeps a reference to the solution.
    SolutionShader(const Solution& solution, const RenderOptions& options, const Workers& workers);
    [[nodiscard]] Sight look(const Ray& ray) const;

private:
    /// Values at the vertices of the fronts, then of the backs.
    using VertexField = std::array<std::vector<Spectrum>, 2>;
    [[nodiscard]] VertexField interpolated(const std::vector<Spectrum>& of_patches,
                                           const std::vector<float>& weights,
                                           const Workers& workers) const;
    [[nodiscard]] Spectrum irradiance(const std::vector<Spectrum>& of_patches,
                                      const VertexField& of_vertices, const Hit& hit) const;
    [[nodiscard]] Spectrum traced_irradiance(const Hit& hit) const;

    const Solution& solution_;
    RenderOptions options_;
    std::vector<Facet> facets_;
    RayTracer rays_;
    VertexGrid grid_;
    VertexField direct_, indirect_;
};

}  // namespace transillum
