/// Sheets as half-edge surfaces: what CGAL's polygon mesh processing works on.
#pragma once

#include "repair/defects/find_sheets.h"
#include "repair/leaks/side_graph.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <span>
#include <vector>

namespace transillum {

struct ShellTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    FaceAttributes(OpenMesh::Attributes::None);
    VertexAttributes(OpenMesh::Attributes::None);
};
using ShellMesh = OpenMesh::TriMesh_ArrayKernelT<ShellTraits>;

/// Manifold and oriented. Faces are joined at edges of two triangles only; each fan of a vertex of
/// several is a vertex of its own, and so is each face's edge where three or more meet.
struct Shell {
    ShellMesh mesh;
    std::vector<Side> faces;           ///< one a face: the side that is its front
    std::vector<std::uint32_t> edges;  ///< one a half-edge: 3 * triangle + corner where its edge
                                       ///< starts; at a border that of the opposite one
};

/// Makes them, sheet by sheet.
class Shells {
public:
    /// \param sheets of the soup, which has to outlive this
    Shells(const TriangleSoup& soup, const EdgeTable& edges, const Sheets& sheets);

    /// All triangles run like the sheet's first. Where no orientation is consistent, each is there
    /// twice, once from either side: the sheet's oriented double cover, whose border has two loops
    /// for each of the sheet's.
    [[nodiscard]] Shell make(std::uint32_t sheet) const;

    /// Does an edge (3 * triangle + corner) have one triangle?
    [[nodiscard]] bool is_border(std::uint32_t edge) const { return across_[edge] == border; }

private:
    static constexpr std::uint32_t many = 0xffffffffu, border = 0xfffffffeu;

    [[nodiscard]] std::span<const Side> faces_of(std::uint32_t sheet) const {
        return {faces_.data() + first_[sheet], faces_.data() + first_[sheet + 1]};
    }

    const TriangleSoup& soup_;
    std::vector<std::uint32_t> across_;  ///< one an edge (3 * triangle + corner): 2 * the one of
                                         ///< the other triangle, one more where they run alike
    std::vector<Side> faces_;            ///< by sheet
    std::vector<std::uint32_t> first_;   ///< one a sheet, and the end
    std::vector<std::uint32_t> place_;   ///< one a side: its place among its sheet's faces
};

}  // namespace transillum
