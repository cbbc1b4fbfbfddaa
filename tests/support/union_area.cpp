#include "support/union_area.h"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/box_intersection_d.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

namespace transillum::testing_support {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
using Corners2 = std::array<Kernel::Point_2, 3>;

class Overlaps {
public:
    Overlaps(const TriangleSoup& soup, double tolerance)
        : soup_(soup), tolerance_(tolerance), cluster_(soup.triangles.size()) {
        std::iota(cluster_.begin(), cluster_.end(), 0u);
        for (const glm::dvec3& p : soup.positions) points_.emplace_back(p.x, p.y, p.z);
        std::vector<Box> boxes;
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
            if (has_area(soup, t)) boxes.emplace_back(box_of(t), t);
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
            if (is_in_one_plane(a.info(), b.info()) && share_area(a.info(), b.info()))
                join(a.info(), b.info());
        });
    }

    [[nodiscard]] std::map<std::uint32_t, std::vector<std::uint32_t>> clusters() {
        std::map<std::uint32_t, std::vector<std::uint32_t>> members;
        for (std::uint32_t t = 0; t < cluster_.size(); ++t)
            if (has_area(soup_, t)) members[find(t)].push_back(t);
        return members;
    }

    /// Of several triangles in one plane.
    [[nodiscard]] double area_of(const std::vector<std::uint32_t>& members) const {
        const std::uint32_t first = *std::ranges::max_element(
            members, {}, [&](std::uint32_t t) { return glm::length(area_vector(soup_, t)); });
        const int axis = steepest_axis(first);
        std::vector<CGAL::Polygon_2<Kernel>> polygons;
        for (const std::uint32_t t : members) {
            const Corners2 c = projected(t, first, axis);
            if (CGAL::orientation(c[0], c[1], c[2]) == CGAL::COLLINEAR) continue;
            polygons.emplace_back(c.begin(), c.end());
        }
        CGAL::Polygon_set_2<Kernel> all;
        all.join(polygons.begin(), polygons.end());
        std::vector<CGAL::Polygon_with_holes_2<Kernel>> parts;
        all.polygons_with_holes(std::back_inserter(parts));
        Kernel::FT area = 0;
        for (const auto& part : parts) {
            area += part.outer_boundary().area();
            for (auto hole = part.holes_begin(); hole != part.holes_end(); ++hole)
                area += hole->area();  // negative
        }
        const Kernel::Vector_3 n = normal(first);
        CGAL::exact(area);
        const Kernel::FT slope = n.squared_length() / (n[axis] * n[axis]);
        return CGAL::to_double(CGAL::exact(area)) * std::sqrt(CGAL::to_double(CGAL::exact(slope)));
    }

private:
    [[nodiscard]] const Kernel::Point_3& corner(std::uint32_t t, int i) const {
        return points_[soup_.triangles[t].vertices[i]];
    }
    [[nodiscard]] Kernel::Vector_3 normal(std::uint32_t t) const {
        return CGAL::cross_product(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    }
    [[nodiscard]] CGAL::Bbox_3 box_of(std::uint32_t t) const {
        const CGAL::Bbox_3 b = corner(t, 0).bbox() + corner(t, 1).bbox() + corner(t, 2).bbox();
        return {b.xmin() - tolerance_, b.ymin() - tolerance_, b.zmin() - tolerance_,
                b.xmax() + tolerance_, b.ymax() + tolerance_, b.zmax() + tolerance_};
    }
    [[nodiscard]] bool is_in_one_plane(std::uint32_t a, std::uint32_t b) const {
        return is_in_plane_of(a, b) && (tolerance_ == 0.0 || is_in_plane_of(b, a));
    }
    [[nodiscard]] bool is_in_plane_of(std::uint32_t a, std::uint32_t b) const {
        const glm::dvec3 unit = glm::normalize(area_vector(soup_, a));
        const auto position = [&](std::uint32_t t, int i) {
            return soup_.positions[soup_.triangles[t].vertices[i]];
        };
        for (int i = 0; i < 3; ++i) {
            if (CGAL::coplanar(corner(a, 0), corner(a, 1), corner(a, 2), corner(b, i))) continue;
            if (std::abs(glm::dot(position(b, i) - position(a, 0), unit)) > tolerance_ ||
                tolerance_ == 0.0)
                return false;
        }
        return true;
    }
    /// Along which its projection has area.
    [[nodiscard]] int steepest_axis(std::uint32_t t) const {
        const glm::dvec3 n = glm::abs(area_vector(soup_, t));
        return n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
    }
    /// Onto the plane of another, from there along an axis. Counter-clockwise.
    [[nodiscard]] Corners2 projected(std::uint32_t t, std::uint32_t plane, int axis) const {
        const Kernel::Plane_3 onto(corner(plane, 0), corner(plane, 1), corner(plane, 2));
        Corners2 c;
        for (int i = 0; i < 3; ++i) {
            const Kernel::Point_3 p =
                onto.has_on(corner(t, i)) ? corner(t, i) : onto.projection(corner(t, i));
            c[i] = {p[(axis + 1) % 3], p[(axis + 2) % 3]};
        }
        if (CGAL::orientation(c[0], c[1], c[2]) == CGAL::CLOCKWISE) std::swap(c[1], c[2]);
        return c;
    }
    /// Convex shapes have no inner point in common where an edge's line separates them.
    [[nodiscard]] bool share_area(std::uint32_t a, std::uint32_t b) const {
        const int axis = steepest_axis(a);
        const std::array<Corners2, 2> both{projected(a, a, axis), projected(b, a, axis)};
        for (int which = 0; which < 2; ++which)
            for (int i = 0; i < 3; ++i) {
                const Corners2 &edge = both[which], &other = both[1 - which];
                bool separates = true;
                for (const Kernel::Point_2& p : other)
                    separates = separates &&
                                CGAL::orientation(edge[i], edge[(i + 1) % 3], p) != CGAL::LEFT_TURN;
                if (separates) return false;
            }
        return true;
    }
    std::uint32_t find(std::uint32_t t) {
        while (cluster_[t] != t) t = cluster_[t] = cluster_[cluster_[t]];
        return t;
    }
    void join(std::uint32_t a, std::uint32_t b) { cluster_[find(a)] = find(b); }

    const TriangleSoup& soup_;
    double tolerance_;
    std::vector<std::uint32_t> cluster_;
    std::vector<Kernel::Point_3> points_;
};

long double area_of(const TriangleSoup& soup, std::uint32_t t) {
    const auto& v = soup.triangles[t].vertices;
    using Vector = glm::vec<3, long double>;
    const Vector a(soup.positions[v[0]]), b(soup.positions[v[1]]), c(soup.positions[v[2]]);
    return glm::length(glm::cross(b - a, c - a)) / 2;
}

}  // namespace

UnionArea union_area(const TriangleSoup& soup, double tolerance) {
    long double covered = 0, sum = 0;
    UnionArea area;
    Overlaps overlaps(soup, tolerance);
    for (const auto& [root, members] : overlaps.clusters()) {
        for (const std::uint32_t t : members) sum += area_of(soup, t);
        if (members.size() == 1) {
            covered += area_of(soup, members[0]);
            continue;
        }
        covered += overlaps.area_of(members);
        ++area.clusters;
        area.overlapping += members.size();
    }
    area.covered = static_cast<double>(covered);
    area.sum = static_cast<double>(sum);
    return area;
}

}  // namespace transillum::testing_support
