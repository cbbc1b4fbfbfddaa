#include "repair/exact/flatten.h"

#include <transillum/base/disjoint_sets.h>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace transillum {

namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
using Triangle = std::array<glm::dvec3, 3>;

/// Sine of the least angle between planes whose meeting is looked for.
constexpr double least_sine = 1e-2;

class Flattening {
public:
    Flattening(const TriangleSoup& soup, double tolerance)
        : soup_(soup), tolerance_(tolerance), clusters_(soup.triangles.size()) {
        normals_.reserve(soup.triangles.size());
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
            normals_.push_back(glm::normalize(area_vector(soup, t)));
        join_overlapping();
    }

    FlatVertices run() {
        FlatVertices flat;
        for (const auto& [vertex, planes] : planes_of_vertices()) move(vertex, planes, flat);
        while (keep_areas(flat)) {
        }
        return flat;
    }

private:
    /// Small triangles may lose their area, or turn over: they stay as they are. \returns whether
    /// there were any
    [[nodiscard]] bool keep_areas(FlatVertices& flat) const {
        bool any = false;
        for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
            const auto& v = soup_.triangles[t].vertices;
            const auto is_flat = [&](std::uint32_t i) { return flat.positions.contains(i); };
            if (std::ranges::none_of(v, is_flat)) continue;
            std::array<Exact::Point_3, 3> p;
            for (int i = 0; i < 3; ++i)
                p[i] = is_flat(v[i]) ? flat.positions.at(v[i]) : exact_point(soup_.positions[v[i]]);
            const Exact::Vector_3 normal = CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
            const glm::dvec3 before = normals_[t];
            if (normal * Exact::Vector_3(before.x, before.y, before.z) > 0) continue;
            for (const std::uint32_t i : v) any |= flat.positions.erase(i) > 0;
        }
        return any;
    }

    [[nodiscard]] Triangle corners(std::uint32_t t) const {
        const auto& v = soup_.triangles[t].vertices;
        return {soup_.positions[v[0]], soup_.positions[v[1]], soup_.positions[v[2]]};
    }

    void join_overlapping() {
        std::vector<Box> boxes;
        for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
            const Triangle c = corners(t);
            const glm::dvec3 low = glm::min(c[0], glm::min(c[1], c[2])) - tolerance_;
            const glm::dvec3 high = glm::max(c[0], glm::max(c[1], c[2])) + tolerance_;
            boxes.emplace_back(CGAL::Bbox_3(low.x, low.y, low.z, high.x, high.y, high.z), t);
        }
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
            if (overlap(a.info(), b.info())) {
                pairs_.emplace_back(a.info(), b.info());
                return;
            }
            find_standing(a.info(), b.info());
            find_standing(b.info(), a.info());
        });
        for (const auto& [a, b] : pairs_) {
            clusters_.join(a, b);
            members_.push_back(a);
            members_.push_back(b);
        }
        std::ranges::sort(members_);
        members_.erase(std::ranges::unique(members_).begin(), members_.end());
        join_neighbours();
    }

    /// Of triangles that share a vertex and a plane, both overlapping others, the vertex can't be
    /// in two planes that are almost the same.
    void join_neighbours() {
        std::map<std::uint32_t, std::vector<std::uint32_t>> at_vertex;
        for (const std::uint32_t t : members_)
            for (const std::uint32_t v : soup_.triangles[t].vertices) {
                for (const std::uint32_t other : at_vertex[v])
                    if (share_plane(t, other)) clusters_.join(t, other);
                at_vertex[v].push_back(t);
            }
    }

    [[nodiscard]] bool share_plane(std::uint32_t a, std::uint32_t b) const {
        return std::abs(glm::dot(normals_[a], normals_[b])) >= 0.5 &&
               is_in_plane_of(corners(a), b) && is_in_plane_of(corners(b), a);
    }

    [[nodiscard]] bool is_in_plane_of(const Triangle& t, std::uint32_t of) const {
        const glm::dvec3 origin = corners(of)[0];
        return std::ranges::all_of(t, [&](const glm::dvec3& p) {
            return std::abs(glm::dot(p - origin, normals_[of])) <= tolerance_;
        });
    }

    /// Does an edge of `t` keep the other from its inside, but for the tolerance?
    [[nodiscard]] bool separates(const Triangle& t, const glm::dvec3& normal,
                                 const Triangle& other) const {
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 inwards = glm::normalize(glm::cross(normal, t[(i + 1) % 3] - t[i]));
            if (std::ranges::all_of(other, [&](const glm::dvec3& p) {
                    return glm::dot(p - t[i], inwards) <= tolerance_;
                }))
                return true;
        }
        return false;
    }

    [[nodiscard]] bool overlap(std::uint32_t a, std::uint32_t b) const {
        return share_plane(a, b) && !separates(corners(a), normals_[a], corners(b)) &&
               !separates(corners(b), normals_[b], corners(a));
    }

    /// Vertices and edges of `t` that lie in the other's plane and reach its inside.
    void find_standing(std::uint32_t t, std::uint32_t on) {
        const Triangle &face = corners(on), &corner = corners(t);
        std::array<std::uint32_t, 3> standing{};
        int count = 0;
        for (int i = 0; i < 3; ++i) {
            if (std::abs(glm::dot(corner[i] - face[0], normals_[on])) > tolerance_) continue;
            standing[count++] = static_cast<std::uint32_t>(i);
        }
        if (count == 0 || count == 3) return;
        const glm::dvec3 &from = corner[standing[0]], &to = corner[standing[count - 1]];
        if (separates(face, normals_[on], {from, to, to}) || passes(face, normals_[on], from, to))
            return;
        for (int i = 0; i < count; ++i)
            standing_.emplace_back(soup_.triangles[t].vertices[standing[i]], on);
    }

    /// Does the line of an edge in the face's plane leave it on one side?
    [[nodiscard]] bool passes(const Triangle& face, const glm::dvec3& normal,
                              const glm::dvec3& from, const glm::dvec3& to) const {
        const glm::dvec3 across = glm::cross(normal, to - from);
        if (across == glm::dvec3(0.0)) return false;
        const auto side = [&](const glm::dvec3& p) {
            return glm::dot(p - from, glm::normalize(across));
        };
        return std::ranges::all_of(face, [&](const auto& p) { return side(p) <= tolerance_; }) ||
               std::ranges::all_of(face, [&](const auto& p) { return side(p) >= -tolerance_; });
    }

    /// Of every vertex of what overlaps, the triangles that stand for its planes.
    std::map<std::uint32_t, std::vector<std::uint32_t>> planes_of_vertices() {
        std::map<std::uint32_t, std::uint32_t> largest;
        const auto area = [&](std::uint32_t t) { return glm::length(area_vector(soup_, t)); };
        for (const std::uint32_t t : members_) {
            const auto at = largest.try_emplace(clusters_.find(t), t).first;
            if (area(t) > area(at->second)) at->second = t;
        }
        std::map<std::uint32_t, std::vector<std::uint32_t>> planes;
        const auto add = [&](std::uint32_t v, std::uint32_t t) {
            const auto found = largest.find(clusters_.find(t));
            const std::uint32_t plane = found == largest.end() ? t : found->second;
            if (std::ranges::count(planes[v], plane) == 0) planes[v].push_back(plane);
        };
        for (const std::uint32_t t : members_)
            for (const std::uint32_t v : soup_.triangles[t].vertices) add(v, t);
        for (const auto& [v, t] : standing_) add(v, t);
        return planes;
    }

    /// Planes that are nearly parallel to others have no meeting near by and are left out.
    [[nodiscard]] std::vector<std::uint32_t> independent(
        const std::vector<std::uint32_t>& planes) const {
        std::vector<std::uint32_t> chosen;
        std::vector<glm::dvec3> basis;
        for (const std::uint32_t plane : planes) {
            glm::dvec3 rest = normals_[plane];
            for (const glm::dvec3& b : basis) rest -= glm::dot(rest, b) * b;
            if (glm::length(rest) < least_sine) continue;
            chosen.push_back(plane);
            basis.push_back(glm::normalize(rest));
        }
        return chosen;
    }

    void move(std::uint32_t vertex, const std::vector<std::uint32_t>& planes,
              FlatVertices& flat) const {
        const Exact::Point_3 from = exact_point(soup_.positions[vertex]);
        std::vector<Exact::Plane_3> exact;
        bool is_there = true;
        for (const std::uint32_t t : independent(planes)) {
            const Triangle c = corners(t);
            exact.emplace_back(exact_point(c[0]), exact_point(c[1]), exact_point(c[2]));
            is_there = is_there && exact.back().has_on(from);
        }
        if (is_there) return;
        const Exact::Point_3 to = nearest_on(exact, from);
        to.exact();  // lets go of what it was constructed from
        const double distance = std::sqrt(CGAL::to_double(CGAL::squared_distance(from, to)));
        if (distance > 2.0 * tolerance_) return;
        flat.positions.emplace(vertex, to);
        flat.furthest = std::max(flat.furthest, distance);
    }

    /// The point of one, two or three planes that is nearest to `p`.
    [[nodiscard]] static Exact::Point_3 nearest_on(const std::vector<Exact::Plane_3>& planes,
                                                   const Exact::Point_3& p) {
        if (planes.size() == 1) return planes[0].projection(p);
        const Exact::Vector_3 n0 = planes[0].orthogonal_vector(),
                              n1 = planes[1].orthogonal_vector();
        const Exact::Plane_3 third =
            planes.size() == 2 ? Exact::Plane_3(p, CGAL::cross_product(n0, n1)) : planes[2];
        const Exact::Vector_3 n2 = third.orthogonal_vector();
        const Exact::FT det = CGAL::determinant(n0, n1, n2);
        const Exact::Vector_3 sum = -planes[0].d() * CGAL::cross_product(n1, n2) -
                                    planes[1].d() * CGAL::cross_product(n2, n0) -
                                    third.d() * CGAL::cross_product(n0, n1);
        return CGAL::ORIGIN + sum / det;
    }

    const TriangleSoup& soup_;
    double tolerance_;
    DisjointSets clusters_;
    std::vector<glm::dvec3> normals_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
    std::vector<std::uint32_t> members_;                             ///< triangles in pairs
    std::vector<std::pair<std::uint32_t, std::uint32_t>> standing_;  ///< vertices, on what
};

}  // namespace

FlatVertices flatten(const TriangleSoup& soup, double tolerance) {
    return Flattening(soup, tolerance).run();
}

}  // namespace transillum
