/// Vertices of the subdivision, for Gouraud interpolation. Leaves share a vertex only within a
/// shading fan: nothing is interpolated across creases, materials or objects.
#pragma once

#include <transillum/base/parallel.h>
#include <transillum/geometry/patch_hierarchy.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

struct VertexGrid {
    /// A vertex within the edge of a larger leaf, of its root or across: it takes its value from
    /// the ends of the longest such edge, so that no seam shows.
    struct Hanging {
        std::uint32_t vertex, from, to;
        float share;  ///< of the way from `from` to `to`
    };

    std::vector<std::array<std::uint32_t, 3>> leaf_vertices;  ///< as leaf_corners
    std::vector<glm::dvec3> positions;                        ///< one a vertex
    std::vector<Hanging> hanging;               ///< those that hang on others come after them
    std::vector<std::uint32_t> first_touching;  ///< one a vertex, and the end
    std::vector<std::uint32_t> touching;        ///< leaves, vertex by vertex
    std::vector<glm::dvec3> leaf_centres;
    std::vector<glm::dvec3> leaf_normals;

    [[nodiscard]] std::size_t vertex_count() const { return positions.size(); }
    [[nodiscard]] std::span<const std::uint32_t> leaves_at(std::uint32_t vertex) const {
        return {touching.data() + first_touching[vertex],
                touching.data() + first_touching[vertex + 1]};
    }
};

[[nodiscard]] VertexGrid build_vertex_grid(const SurfaceMesh& mesh, const PatchHierarchy& patches);

/// Values at the vertices of one side, from means over patches: the weighted mean of the patches
/// that touch the vertex, moved from their centre to the vertex along the gradient fitted to its
/// surroundings. A linear field is reproduced, at borders too; where the surroundings are no plane
/// the gradient is trusted as far as it explains them.
/// \param values, weights one a leaf
[[nodiscard]] std::vector<Spectrum> vertex_values(const VertexGrid& grid,
                                                  std::span<const Spectrum> values,
                                                  std::span<const float> weights,
                                                  const Workers& workers);

}  // namespace transillum
