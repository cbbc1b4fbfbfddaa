#include "repair/defects/measure_shell.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <iterator>

namespace transillum {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// Seen from a vertex of the surface, so that places far from the origin cost no digits, and six
/// times as long, as CGAL takes a sixth of every cone: the boxes of a test have exact volumes.
struct PointsFromTip {
    using category = boost::readable_property_map_tag;
    using key_type = ShellMesh::VertexHandle;
    using value_type = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
    using reference = value_type;

    static constexpr double stretch = 6.0;
    const ShellMesh& mesh;
    ShellMesh::Point tip;

    friend value_type get(const PointsFromTip& map, key_type vertex) {
        const ShellMesh::Point p = map.mesh.point(vertex) - map.tip;
        return {stretch * p[0], p[1], p[2]};
    }
};

}  // namespace

bool is_closed(const Shell& shell) {
    return CGAL::is_closed(shell.mesh);
}

double enclosed_volume(const Shell& shell) {
    const ShellMesh& mesh = shell.mesh;
    const PointsFromTip points{mesh, mesh.point(ShellMesh::VertexHandle(0))};
    return pmp::volume(mesh, CGAL::parameters::vertex_point_map(points)) / PointsFromTip::stretch;
}

std::vector<std::vector<std::uint32_t>> border_loops(const Shell& shell) {
    // It asks for a mesh that may be changed, and doesn't change it.
    auto& mesh = const_cast<ShellMesh&>(shell.mesh);
    std::vector<ShellMesh::HalfedgeHandle> firsts;
    pmp::extract_boundary_cycles(mesh, std::back_inserter(firsts));
    std::vector<std::vector<std::uint32_t>> loops;
    for (const auto first : firsts) {
        std::vector<std::uint32_t>& loop = loops.emplace_back();
        for (const auto h : CGAL::halfedges_around_face(first, mesh))
            loop.push_back(shell.edges[static_cast<std::size_t>(h.idx())]);
    }
    return loops;
}

}  // namespace transillum
