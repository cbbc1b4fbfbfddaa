#include "repair/exact/triangle_meeting.h"

#include "repair/exact/flatten.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace transillum {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<std::uint32_t, 3>;
using Signs = std::array<int, 3>;

/// Predicates on vertices of a soup.
class Predicates {
public:
    Predicates(const TriangleSoup& soup, const FlatVertices* flat)
        : positions_(soup.positions.data()),
          flat_(flat && !flat->positions.empty() ? &flat->positions : nullptr) {}

    /// On which side of the plane (a, b, c) is d?
    [[nodiscard]] int side(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                           std::uint32_t d) const {
        if (is_flat({a, b, c, d}))
            return CGAL::orientation(exactly(a), exactly(b), exactly(c), exactly(d));
        return CGAL::orientation(at(a), at(b), at(c), at(d));
    }
    [[nodiscard]] Signs sides(const Corners& plane, const Corners& of) const {
        Signs signs{};
        for (int i = 0; i < 3; ++i)
            if (std::ranges::find(plane, of[i]) == plane.end())
                signs[i] = side(plane[0], plane[1], plane[2], of[i]);
        return signs;
    }
    /// How do three points turn, seen along a coordinate?
    [[nodiscard]] int turn(int drop, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const int x = drop == 0 ? 1 : 0, y = drop == 2 ? 1 : 2;
        if (is_flat({a, b, c})) {
            const auto seen = [&](std::uint32_t v) {
                const Exact::Point_3 p = exactly(v);
                return Exact::Point_2(p[x], p[y]);
            };
            return CGAL::orientation(seen(a), seen(b), seen(c));
        }
        const auto seen = [&](std::uint32_t v) {
            return Kernel::Point_2(positions_[v][x], positions_[v][y]);
        };
        return CGAL::orientation(seen(a), seen(b), seen(c));
    }
    [[nodiscard]] glm::dvec3 position(std::uint32_t v) const { return positions_[v]; }

private:
    [[nodiscard]] bool is_flat(std::initializer_list<std::uint32_t> vertices) const {
        return flat_ &&
               std::ranges::any_of(vertices, [&](std::uint32_t v) { return flat_->contains(v); });
    }
    [[nodiscard]] Exact::Point_3 exactly(std::uint32_t v) const {
        const auto moved = flat_->find(v);
        return moved != flat_->end() ? moved->second : exact_point(positions_[v]);
    }
    [[nodiscard]] Kernel::Point_3 at(std::uint32_t v) const {
        const glm::dvec3& p = positions_[v];
        return {p.x, p.y, p.z};
    }
    const glm::dvec3* positions_;
    const std::unordered_map<std::uint32_t, Exact::Point_3>* flat_;
};

/// Turning senses in the plane of a triangle, seen along the coordinate that it faces most.
class Plane {
public:
    Plane(const Predicates& predicates, const Corners& t) : predicates_(predicates) {
        const glm::dvec3 a = predicates.position(t[0]);
        const glm::dvec3 normal =
            glm::abs(glm::cross(predicates.position(t[1]) - a, predicates.position(t[2]) - a));
        drop_ = normal.x >= normal.y && normal.x >= normal.z ? 0 : normal.y >= normal.z ? 1 : 2;
        // Where rounding chose a coordinate along which there is no area, another has some.
        for (int i = 0; i < 3 && turn(t[0], t[1], t[2]) == 0; ++i) drop_ = i;
        sense_ = turn(t[0], t[1], t[2]);
    }
    [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return predicates_.turn(drop_, a, b, c);
    }
    /// Is a point of the plane in the triangle, borders included?
    [[nodiscard]] bool holds(const Corners& t, std::uint32_t p) const {
        for (int i = 0; i < 3; ++i)
            if (turn(t[i], t[(i + 1) % 3], p) * sense_ < 0) return false;
        return true;
    }
    /// Does an edge's line keep the others' inside from its own?
    [[nodiscard]] bool separates(const Corners& t, const Corners& other) const {
        const int sense = turn(t[0], t[1], t[2]);
        for (int i = 0; i < 3; ++i) {
            const auto outside = [&](std::uint32_t p) {
                return turn(t[i], t[(i + 1) % 3], p) * sense <= 0;
            };
            if (std::ranges::all_of(other, outside)) return true;
        }
        return false;
    }

private:
    const Predicates& predicates_;
    int drop_ = 2;
    int sense_ = 0;
};

bool is_shared(const Corners& t, std::uint32_t vertex) {
    return std::ranges::find(t, vertex) != t.end();
}

std::optional<TriangleMeeting> meet_in_plane(const Predicates& predicates, const Corners& a,
                                             const Corners& b) {
    const Plane plane(predicates, a);
    if (!plane.separates(a, b) && !plane.separates(b, a))
        return TriangleMeeting{Meeting::overlap, {}};
    // Without shared area, every corner of what is shared is a vertex.
    TriangleMeeting meeting{Meeting::touching, {}};
    const auto gather = [&](const Plane& in, const Corners& t, const Corners& other) {
        for (const std::uint32_t v : other)
            if (!is_shared(t, v) && in.holds(t, v)) meeting.points.push_back({.u = v});
    };
    gather(plane, a, b);
    gather(Plane(predicates, b), b, a);
    if (meeting.points.empty()) return std::nullopt;
    return meeting;
}

/// What is met while the corners of the shared segment are gathered.
struct Gathering {
    std::vector<MeetingPoint> points;
    int through_faces = 0;  ///< edges that pass through the inside of the other triangle
    int through_edges = 0;  ///< edges that cross an edge of the other
};

/// Corners of `t` that lie in `face`, and crossings of its edges with the inside or border of it.
/// Crossings with a corner of `face` are found as that corner, from the other triangle.
void gather(const Predicates& predicates, const Corners& face, std::uint32_t face_number,
            const Corners& t, const Signs& signs, Gathering& met) {
    const Plane plane(predicates, face);
    for (int i = 0; i < 3; ++i)
        if (signs[i] == 0 && !is_shared(face, t[i]) && plane.holds(face, t[i]))
            met.points.push_back({.u = t[i]});
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (signs[i] * signs[j] >= 0) continue;
        const auto [u, v] = std::minmax(t[i], t[j]);
        Signs around{};
        for (int k = 0; k < 3; ++k) around[k] = predicates.side(u, v, face[k], face[(k + 1) % 3]);
        const auto [least, most] = std::ranges::minmax(around);
        const auto zeros = std::ranges::count(around, 0);
        if (least * most < 0 || zeros > 1) continue;
        ++(zeros == 0 ? met.through_faces : met.through_edges);
        met.points.push_back({.u = u, .v = v, .face = face_number});
    }
}

/// Strictly on one side, or touching the plane in shared vertices alone.
bool is_clear(const Signs& signs, int shared) {
    const auto [least, most] = std::ranges::minmax(signs);
    return least * most >= 0 && std::ranges::count(signs, 0) == shared;
}

}  // namespace

std::optional<TriangleMeeting> meet(const TriangleSoup& soup, std::uint32_t a, std::uint32_t b,
                                    const FlatVertices* flat) {
    const Corners& ta = soup.triangles[a].vertices;
    const Corners& tb = soup.triangles[b].vertices;
    const auto shared = static_cast<int>(
        std::ranges::count_if(tb, [&](std::uint32_t v) { return is_shared(ta, v); }));
    if (shared == 3) return std::nullopt;
    const Predicates predicates(soup, flat);
    const Signs signs_b = predicates.sides(ta, tb);
    if (is_clear(signs_b, shared)) return std::nullopt;
    if (signs_b == Signs{0, 0, 0}) return meet_in_plane(predicates, ta, tb);
    if (shared == 2) return std::nullopt;
    const Signs signs_a = predicates.sides(tb, ta);
    if (is_clear(signs_a, shared)) return std::nullopt;
    Gathering met;
    gather(predicates, ta, a, tb, signs_b, met);
    gather(predicates, tb, b, ta, signs_a, met);
    if (met.points.empty()) return std::nullopt;
    if (shared == 1)
        for (const std::uint32_t v : tb)
            if (is_shared(ta, v)) met.points.push_back({.u = v});
    // Edges that only cross each other in one point touch; the crossing is found from one of the
    // two or from both.
    const bool single =
        met.points.size() <= static_cast<std::size_t>(met.through_edges) && met.through_edges <= 2;
    const bool crosses = met.through_faces > 0 || (met.through_edges > 0 && !single);
    return TriangleMeeting{crosses ? Meeting::crossing : Meeting::touching, std::move(met.points)};
}

}  // namespace transillum
