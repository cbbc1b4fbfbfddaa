/// From a chart to the texels of a lightmap.
#pragma once

#include "render/lightmap/chart.h"
#include "render/vertex_grid.h"

#include <transillum/render/image.h>

#include <span>

namespace transillum {

/// Radiance anywhere on a solution's surface, from that at the vertices of its grid.
struct RadianceField {
    const Solution& solution;
    const VertexGrid& grid;
    std::span<const Spectrum> values;  ///< as surface_radiance() gives them

    /// At barycentric coordinates (b1, b2) of a root.
    [[nodiscard]] Spectrum at(const RootSide& side, const glm::dvec2& b) const;
    [[nodiscard]] bool emits(const RootSide& side) const;
};

/// Writes the texels of a chart, and which of them see an emitter: what is seen at their middle or,
/// about the chart, at the nearest point of it (dilation). Then moves those at borders so that
/// linear filtering gives there what the surface shines with, on either side of a seam (stitching).
void fill_chart(const Chart& chart, const RadianceField& field, Image& lightmap);

}  // namespace transillum
