#include "support/surface_distance.h"

#include <transillum/base/sampling.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace transillum::testing_support {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Vector = glm::vec<3, long double>;

Kernel::Point_3 point(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

Triangles triangles_of(const TriangleSoup& soup) {
    Triangles triangles;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (!has_area(soup, t)) continue;
        const auto& v = soup.triangles[t].vertices;
        triangles.emplace_back(point(soup.positions[v[0]]), point(soup.positions[v[1]]),
                               point(soup.positions[v[2]]));
    }
    return triangles;
}

/// Of the origin.
long double distance_to_segment(const Vector& a, const Vector& b) {
    const Vector along = b - a;
    const long double square = glm::dot(along, along);
    const long double s =
        square > 0 ? std::clamp<long double>(-glm::dot(a, along) / square, 0, 1) : 0;
    return glm::length(a + s * along);
}

/// Never less than it is, but for rounding: the tree's own is not exact for needles.
double distance(const Kernel::Point_3& from, const Kernel::Triangle_3& triangle) {
    std::array<Vector, 3> v;
    for (int i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis)
            v[i][axis] = static_cast<long double>(triangle[i][axis]) - from[axis];
    long double least = std::min({distance_to_segment(v[0], v[1]), distance_to_segment(v[1], v[2]),
                                  distance_to_segment(v[2], v[0])});
    const Vector n = glm::cross(v[1] - v[0], v[2] - v[0]);
    Vector weights{glm::dot(n, glm::cross(v[1], v[2])), glm::dot(n, glm::cross(v[2], v[0])),
                   glm::dot(n, glm::cross(v[0], v[1]))};
    if (weights.x >= 0 && weights.y >= 0 && weights.z >= 0) {
        const long double sum = weights.x + weights.y + weights.z;
        if (sum > 0) {
            weights /= sum;
            least = std::min(least,
                             glm::length(weights.x * v[0] + weights.y * v[1] + weights.z * v[2]));
        }
    }
    return static_cast<double>(least);
}

/// Calls `use` with every sample.
template <class Use>
void sample(const Kernel::Triangle_3& t, std::uint64_t random_points, std::uint64_t stream,
            const Use& use) {
    const auto mix = [&](double a, double b, double c) {
        use(CGAL::barycenter(t[0], a, t[1], b, t[2], c));
    };
    for (int i = 0; i < 3; ++i) use(t[i]);
    mix(0.5, 0.5, 0.0);
    mix(0.0, 0.5, 0.5);
    mix(0.5, 0.0, 0.5);
    mix(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0);
    Random random(5, stream);
    for (std::uint64_t i = 0; i < random_points; ++i) {
        const double root = std::sqrt(random.next()), along = random.next();
        mix(1.0 - root, root * (1.0 - along), root * along);
    }
}

double distance(const Kernel::Point_3& from, const Tree& tree) {
    const auto near = tree.closest_point_and_primitive(from);
    double least = distance(from, *near.second);
    if (least == 0.0) return 0.0;
    const Kernel::Vector_3 reach(least, least, least);
    std::vector<Tree::Primitive_id> others;
    tree.all_intersected_primitives(CGAL::Bbox_3((from - reach).bbox() + (from + reach).bbox()),
                                    std::back_inserter(others));
    for (const auto& other : others) least = std::min(least, distance(from, *other));
    return least;
}

double farthest(const Triangles& from, const Triangles& to, std::uint64_t random,
                std::uint64_t& samples, const Workers& workers) {
    if (from.empty()) return 0.0;
    if (to.empty()) return std::numeric_limits<double>::infinity();
    Tree tree(to.begin(), to.end());
    tree.build();
    tree.accelerate_distance_queries();
    double area = 0.0;
    for (const Kernel::Triangle_3& t : from) area += std::sqrt(t.squared_area());
    const auto n = static_cast<std::size_t>(workers.count());
    std::vector<double> largest(n);
    std::vector<std::uint64_t> counts(n);
    workers.for_ranges(from.size(), 64, [&](std::size_t begin, std::size_t end, int w) {
        for (std::size_t i = begin; i < end; ++i) {
            const double share = std::sqrt(from[i].squared_area()) / area;
            const auto points =
                static_cast<std::uint64_t>(std::ceil(static_cast<double>(random) * share));
            sample(from[i], points, i, [&](const Kernel::Point_3& p) {
                largest[w] = std::max(largest[w], distance(p, tree));
                ++counts[w];
            });
        }
    });
    for (const std::uint64_t count : counts) samples += count;
    return *std::ranges::max_element(largest);
}

}  // namespace

SurfaceDistance surface_distance(const TriangleSoup& a, const TriangleSoup& b, std::uint64_t random,
                                 const Workers& workers) {
    const Triangles first = triangles_of(a), second = triangles_of(b);
    SurfaceDistance d;
    d.forth = farthest(first, second, random, d.samples, workers);
    d.back = farthest(second, first, random, d.samples, workers);
    return d;
}

}  // namespace transillum::testing_support
