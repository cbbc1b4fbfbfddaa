/// Light of the light samples at a point of a surface, as its BRDF reflects it (paper §4).
#pragma once

#include "render/reflected_sum.h"
#include "render/shadow_edges.h"
#include "render/surface_point.h"
#include "render/vertex_stencils.h"

#include <transillum/base/parallel.h>
#include <transillum/solution/solution.h>
#include <transillum/visibility/ray_tracer.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

class DirectShader {
public:
    /// Keeps references.
    DirectShader(const Solution& solution, const RayTracer& rays);

    /// Lets `stored` be called for glossy sides. \param grid, stencils null: one value a patch
    void prepare_stored(const VertexGrid* grid, const VertexStencils* stencils,
                        const Workers& workers);

    /// Spares `traced` the rays to light samples that are not in doubt.
    void find_shadow_edges(const VertexGrid& grid, const Workers& workers);

    /// Shadow rays decide which light samples are seen, where that is in doubt.
    [[nodiscard]] Spectrum traced(const SurfacePoint& p) const;
    /// Of the light samples that light a patch, or may, those that are in doubt.
    [[nodiscard]] double doubtful_share() const { return shadow_edges_.doubtful_share(); }
    /// What the solution holds: visibilities of the light samples, or light vectors.
    /// \pre p has a side
    [[nodiscard]] Spectrum stored(const SurfacePoint& p) const;

private:
    /// What a light sample of a surface sends out.
    struct Emitter {
        glm::dvec3 position;
        glm::vec3 normal;
        Spectrum intensity;    ///< along the normal
        float squared_radius;  ///< of a disc as large as the piece it stands for
    };

    [[nodiscard]] bool sees(const SurfacePoint& p, const LightSample& light) const;
    [[nodiscard]] std::array<std::size_t, 3> rows_of(const SurfacePoint& p) const;
    void average_visibility(const VertexStencils& stencils, const Workers& workers);
    void average_vectors(const VertexStencils& stencils, const Workers& workers);
    [[nodiscard]] glm::vec3 average_vector(std::span<const VertexStencils::Entry> entries,
                                           std::size_t column) const;
    void add_samples_of_patch(const SurfacePoint& p, ReflectedSum& sum) const;
    void add_interpolated_samples(const SurfacePoint& p, ReflectedSum& sum) const;
    template <class Use>
    void use_sample(const SurfacePoint& p, std::size_t sample, float share, Use use) const;
    void add_vectors(const SurfacePoint& p, ReflectedSum& sum) const;

    const Solution& solution_;
    const RayTracer& rays_;
    double beyond_ = 0.0;            ///< further than any two points of the surface are apart
    std::vector<Emitter> emitters_;  ///< one a sample; of surfaces alone
    ShadowEdges shadow_edges_;
    const VertexGrid* grid_ = nullptr;
    /// In 255ths, mean of the patches that touch a vertex and face the sample; rows of samples,
    /// padded with zeros.
    std::vector<std::uint8_t> vertex_visibility_;
    std::size_t row_size_ = 0;
    /// Of a surface that faces it: irradiance is its product with the normal. Rows of light
    /// vectors.
    std::vector<glm::vec3> vertex_vectors_;
    std::vector<std::uint32_t> first_row_;  ///< 2 * vertex + back
};

}  // namespace transillum
