#include "repair/defects/edge_table.h"
#include "repair/defects/find_defects.h"

#include <CGAL/box_intersection_d.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <tuple>

namespace transillum {

namespace {

/// Index: of a side for edges, of a vertex for vertices.
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

Box box_around(const glm::dvec3& a, const glm::dvec3& b, double tolerance, std::uint32_t index) {
    const glm::dvec3 low = glm::min(a, b) - tolerance, high = glm::max(a, b) + tolerance;
    return Box(CGAL::Bbox_3(low.x, low.y, low.z, high.x, high.y, high.z), index);
}

struct Border {
    std::vector<Box> edges, vertices;
};

Border find_border(const TriangleSoup& soup, double tolerance) {
    Border border;
    std::vector<bool> is_on_border(soup.positions.size(), false);
    const EdgeTable edges(soup);
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        if (edges[e].size() != 1) continue;
        const EdgeUse& use = edges[e].front();
        border.edges.push_back(
            box_around(soup.positions[use.low], soup.positions[use.high], tolerance, use.side));
        is_on_border[use.low] = is_on_border[use.high] = true;
    }
    for (std::uint32_t v = 0; v < soup.positions.size(); ++v)
        if (is_on_border[v])
            border.vertices.push_back(box_around(soup.positions[v], soup.positions[v], 0.0, v));
    return border;
}

}  // namespace

std::vector<TJunction> find_t_junctions(const TriangleSoup& soup, double tolerance) {
    Border border = find_border(soup, tolerance);
    std::vector<TJunction> found;
    const auto visit = [&](const Box& edge, const Box& point) {
        const std::uint32_t triangle = edge.info() / 3, corner = edge.info() % 3;
        const std::uint32_t vertex = point.info();
        const auto& v = soup.triangles[triangle].vertices;
        if (vertex == v[0] || vertex == v[1] || vertex == v[2]) return;
        const glm::dvec3& p = soup.positions[vertex];
        const glm::dvec3& from = soup.positions[v[corner]];
        const glm::dvec3 along = soup.positions[v[(corner + 1) % 3]] - from;
        const double length = glm::length(along);
        const double parameter = glm::dot(p - from, along / length) / length;
        // At an end, the vertices are near each other: another defect.
        if (!(parameter * length > tolerance && (1.0 - parameter) * length > tolerance)) return;
        if (glm::length(p - (from + parameter * along)) > tolerance) return;
        found.push_back({triangle, corner, vertex, parameter});
    };
    CGAL::box_intersection_d(border.edges.begin(), border.edges.end(), border.vertices.begin(),
                             border.vertices.end(), visit);
    std::ranges::sort(found, {}, [](const TJunction& t) {
        return std::make_tuple(t.triangle, t.edge, t.parameter, t.vertex);
    });
    return found;
}

}  // namespace transillum
