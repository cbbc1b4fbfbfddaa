#define CGAL_NO_CDT_2_WARNING  // of cascades: they are short, and points are evaluated at once

#include "repair/exact/arrange_plane.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <unordered_map>

namespace transillum {

namespace {

constexpr std::uint32_t unnumbered = 0xffffffffu;

struct VertexInfo {
    std::uint32_t number = unnumbered;
};
struct FaceInfo {
    std::uint32_t seen = unnumbered;  ///< the last member that it was looked at for
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Exact>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceInfo, Exact,
                                              CGAL::Constrained_triangulation_face_base_2<Exact>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Exact, Structure, CGAL::Exact_intersections_tag>;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;

/// A plane, seen along the coordinate that it faces most.
class Projection {
public:
    Projection(const Exact::Point_3& a, const Exact::Point_3& b, const Exact::Point_3& c)
        : origin_(a), normal_(CGAL::cross_product(b - a, c - a)) {
        const auto size = [&](int i) { return CGAL::abs(normal_[i]); };
        for (int i = 0; i < 3; ++i)
            if (size(i) > size(drop_)) drop_ = i;
        u_ = (drop_ + 1) % 3;
        v_ = (drop_ + 2) % 3;
    }
    [[nodiscard]] Exact::Point_2 operator()(const Exact::Point_3& p) const {
        return {p[u_], p[v_]};
    }
    [[nodiscard]] Exact::Point_3 lift(const Exact::Point_2& p) const {
        std::array<Exact::FT, 3> lifted;
        lifted[u_] = p.x();
        lifted[v_] = p.y();
        lifted[drop_] = origin_[drop_] - (normal_[u_] * (p.x() - origin_[u_]) +
                                          normal_[v_] * (p.y() - origin_[v_])) /
                                             normal_[drop_];
        return {lifted[0], lifted[1], lifted[2]};
    }

private:
    Exact::Point_3 origin_;
    Exact::Vector_3 normal_;
    int drop_ = 0, u_ = 1, v_ = 2;
};

class PlaneArrangement {
public:
    PlaneArrangement(const TriangleSoup& soup, const ExactPoints& points, const PlaneInput& input)
        : soup_(soup), points_(points), project_(plane_of(soup, input.members.front())) {
        for (const std::uint32_t m : input.members)
            for (const std::uint32_t v : soup.triangles[m].vertices) insert(v);
        for (const std::uint32_t p : input.points) insert(p);
        for (const auto& [a, b] : input.segments) constrain(a, b);
        for (const std::uint32_t m : input.members) {
            const auto& v = soup.triangles[m].vertices;
            for (int i = 0; i < 3; ++i) constrain(v[i], v[(i + 1) % 3]);
        }
    }

    PlaneParts parts(const std::vector<std::uint32_t>& members) {
        PlaneParts result;
        for (const Vertex v : triangulation_.finite_vertex_handles()) {
            if (v->info().number != unnumbered) continue;
            v->info().number = points_.count() + static_cast<std::uint32_t>(result.made.size());
            result.made.push_back(project_.lift(v->point()));
        }
        for (const std::uint32_t m : members) add_parts(m, members.size() == 1, result.parts);
        return result;
    }

private:
    Projection plane_of(const TriangleSoup& soup, std::uint32_t triangle) const {
        const auto& v = soup.triangles[triangle].vertices;
        return {points_[v[0]], points_[v[1]], points_[v[2]]};
    }

    Vertex insert(std::uint32_t number) {
        const auto known = vertices_.find(number);
        if (known != vertices_.end()) return known->second;
        const Vertex v = triangulation_.insert(project_(points_[number]), last_);
        if (triangulation_.dimension() == 2) last_ = v->face();
        v->info().number = number;
        vertices_.emplace(number, v);
        return v;
    }

    void constrain(std::uint32_t a, std::uint32_t b) {
        const Vertex va = insert(a), vb = insert(b);
        if (va != vb) triangulation_.insert_constraint(va, vb);
    }

    /// Members are whole unions of the triangulation's faces, as their edges are constrained.
    void add_parts(std::uint32_t member, bool alone, std::vector<PlanePart>& parts) {
        const auto& corners = soup_.triangles[member].vertices;
        std::array<Exact::Point_2, 3> outline;
        for (int i = 0; i < 3; ++i) outline[i] = vertices_.at(corners[i])->point();
        const auto sense = CGAL::orientation(outline[0], outline[1], outline[2]);
        const auto add = [&](Face f) {
            PlanePart part{member, {}};
            for (int i = 0; i < 3; ++i) part.corners[i] = f->vertex(i)->info().number;
            if (sense < 0) std::swap(part.corners[1], part.corners[2]);
            parts.push_back(part);
        };
        if (alone) {
            for (const Face f : triangulation_.finite_face_handles()) add(f);
            return;
        }
        const auto is_inside = [&](Face f) {
            if (triangulation_.is_infinite(f)) return false;
            for (int i = 0; i < 3; ++i)
                for (int k = 0; k < 3; ++k)
                    if (CGAL::orientation(outline[i], outline[(i + 1) % 3], f->vertex(k)->point()) *
                            sense <
                        0)
                        return false;
            return true;
        };
        std::vector<Face> open;
        const auto look_at = [&](Face f) {
            if (f->info().seen == member) return;
            f->info().seen = member;
            if (is_inside(f)) open.push_back(f);
        };
        const Vertex start = vertices_.at(corners[0]);
        auto around = triangulation_.incident_faces(start);
        for (const auto end = around; open.empty();) {
            look_at(around);
            if (++around == end) break;
        }
        while (!open.empty()) {
            const Face f = open.back();
            open.pop_back();
            add(f);
            for (int i = 0; i < 3; ++i) look_at(f->neighbor(i));
        }
    }

    const TriangleSoup& soup_;
    const ExactPoints& points_;
    Projection project_;
    Triangulation triangulation_;
    Face last_{};
    std::unordered_map<std::uint32_t, Vertex> vertices_;
};

}  // namespace

PlaneParts arrange_plane(const TriangleSoup& soup, const ExactPoints& points,
                         const PlaneInput& input) {
    return PlaneArrangement(soup, points, input).parts(input.members);
}

}  // namespace transillum
