#include "repair/defects/triangle_tree.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <glm/geometric.hpp>

#include <iterator>

namespace transillum {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Boxes = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

}  // namespace

struct TriangleTree::Tree {
    Triangles triangles;
    Boxes boxes;

    [[nodiscard]] std::uint32_t index(Triangles::const_iterator at) const {
        return static_cast<std::uint32_t>(at - triangles.begin());
    }
};

TriangleTree::TriangleTree(const TriangleSoup& soup)
    : tree_(std::make_unique<Tree>()), soup_(soup) {
    tree_->triangles.reserve(soup.triangles.size());
    for (const SoupTriangle& t : soup.triangles)
        tree_->triangles.emplace_back(point(soup.positions[t.vertices[0]]),
                                      point(soup.positions[t.vertices[1]]),
                                      point(soup.positions[t.vertices[2]]));
    tree_->boxes.insert(tree_->triangles.cbegin(), tree_->triangles.cend());
    tree_->boxes.build();
}

TriangleTree::~TriangleTree() = default;

std::optional<TriangleTree::Hit> TriangleTree::first_hit(const glm::dvec3& origin,
                                                         const glm::dvec3& direction,
                                                         const Skip& skip) const {
    const Kernel::Ray_3 ray(point(origin), point(origin + direction));
    const auto skip_at = [&](Triangles::const_iterator at) { return skip(tree_->index(at)); };
    const auto met = tree_->boxes.first_intersected_primitive(ray, skip_at);
    if (!met) return {};
    const std::uint32_t triangle = tree_->index(*met);
    const glm::dvec3 normal = area_vector(soup_, triangle);
    const double slope = glm::dot(normal, direction);
    if (slope == 0.0) return Hit{triangle, 0.0};
    const glm::dvec3& corner = soup_.positions[soup_.triangles[triangle].vertices[0]];
    return Hit{triangle, glm::dot(normal, corner - origin) / slope};
}

std::vector<std::uint32_t> TriangleTree::met_by(const glm::dvec3& from,
                                                const glm::dvec3& to) const {
    std::vector<Triangles::const_iterator> met;
    tree_->boxes.all_intersected_primitives(Kernel::Segment_3(point(from), point(to)),
                                            std::back_inserter(met));
    std::vector<std::uint32_t> triangles;
    for (const auto at : met) triangles.push_back(tree_->index(at));
    return triangles;
}

std::vector<std::uint32_t> TriangleTree::near_to(const glm::dvec3& centre, double radius) const {
    const glm::dvec3 low = centre - radius, high = centre + radius;
    std::vector<Triangles::const_iterator> met;
    tree_->boxes.all_intersected_primitives(
        CGAL::Bbox_3(low.x, low.y, low.z, high.x, high.y, high.z), std::back_inserter(met));
    std::vector<std::uint32_t> triangles;
    for (const auto at : met) triangles.push_back(tree_->index(at));
    return triangles;
}

}  // namespace transillum
