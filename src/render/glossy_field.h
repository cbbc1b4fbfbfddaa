/// The finite elements of glossy sides as an eye sees them (paper §2.1).
#pragma once

#include "render/facets.h"
#include "render/surface_point.h"
#include "render/vertex_stencils.h"

#include <transillum/base/parallel.h>
#include <transillum/solution/solution.h>

#include <glm/mat3x3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

class GlossyField {
public:
    enum class Interpolation {
        none,    ///< the leaf's own elements
        planar,  ///< between leaves of one plane: radiance is what one lobe makes of one field
        smooth   ///< between all leaves that touch, each with its own frame
    };

    GlossyField() = default;
    /// Keeps references. \param grid null: no interpolation; \pre there are glossy sides
    GlossyField(const Solution& solution, const VertexGrid* grid, Interpolation interpolation);

    /// The same with other elements, of either sign.
    [[nodiscard]] GlossyField with_elements(std::span<const Spectrum> elements) const;

    [[nodiscard]] const VertexStencils& stencils() const { return stencils_; }
    [[nodiscard]] const glm::mat3& world_from_local(const GlossySide& side) const {
        return frames_[&side - solution_->glossy.sides.data()];
    }
    /// Radiance that the lobe reflects to the eye. \pre p has a side; the same below
    [[nodiscard]] Spectrum reflected(const SurfacePoint& p) const;
    /// Radiance that the elements hold for a world direction, which points away from the surface:
    /// unless smooth, `reflected` is what the lobe makes of it.
    [[nodiscard]] Spectrum incoming(const SurfacePoint& p, const glm::dvec3& from) const;

private:
    /// The elements of a patch, or their mean at a vertex about which all is plane.
    struct Elements {
        std::uint32_t side;
        const float* bins;  ///< one channel after the other
    };
    void take(std::span<const Spectrum> elements);
    void combine_at_vertices();
    [[nodiscard]] bool is_plane(std::span<const VertexStencils::Entry> entries) const;
    [[nodiscard]] Elements elements_of(std::uint32_t patch, std::uint32_t side) const {
        const GlossySide& s = solution_->glossy.sides[side];
        return {side, bins_.data() +
                          channel_count *
                              (s.first_element + std::uint64_t{patch - s.first_patch} * s.bins())};
    }
    /// Calls body(elements) -> Spectrum for what a point's value is a mean of; their mean.
    template <class Body>
    [[nodiscard]] Spectrum mean(const SurfacePoint& p, Body body) const;

    const Solution* solution_ = nullptr;
    const VertexGrid* grid_ = nullptr;
    Interpolation interpolation_ = Interpolation::none;
    VertexStencils stencils_;
    std::vector<glm::mat3> frames_;  ///< of the sides
    std::vector<float> bins_;        ///< as the solution's, but all of a patch in a row
    std::vector<float> vertex_bins_;
    std::vector<std::uint64_t> vertex_row_;  ///< 2 * vertex + back -> its first bin there, or none
};

}  // namespace transillum
