#include "repair/exact/resolve_intersections.h"

#include "repair/exact/arrange_plane.h"
#include "repair/exact/exact_points.h"
#include "repair/exact/triangle_meeting.h"
#include "repair/part_uvs.h"

#include <transillum/base/disjoint_sets.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace transillum {

namespace {

using Corners = std::array<std::uint32_t, 3>;

struct Met {
    std::uint32_t a = 0, b = 0;
    std::vector<MeetingPoint> points;
};

std::vector<Met> meet_again(const TriangleSoup& soup, const std::vector<MeetingPair>& pairs,
                            const FlatVertices& flat, const Workers& workers) {
    std::vector<Met> met(pairs.size());
    workers.for_ranges(pairs.size(), 256, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            met[i].a = pairs[i].a;
            met[i].b = pairs[i].b;
            if (auto meeting = meet(soup, pairs[i].a, pairs[i].b, &flat))
                met[i].points = std::move(meeting->points);
        }
    });
    return met;
}

/// Constructs the points where edges cross faces, each once.
class Crossings {
public:
    Crossings(const TriangleSoup& soup, const std::vector<Met>& met, ExactPoints& points,
              const Workers& workers) {
        for (const Met& m : met)
            for (const MeetingPoint& p : m.points)
                if (p.v != MeetingPoint::none) keys_.push_back(p);
        std::ranges::sort(keys_, {}, key);
        const auto same = std::ranges::unique(keys_);
        keys_.erase(same.begin(), same.end());
        std::vector<Exact::Point_3> made(keys_.size());
        workers.for_ranges(keys_.size(), 64, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) made[i] = construct(soup, points, keys_[i]);
        });
        numbers_ = points.add(made, workers);
    }
    [[nodiscard]] std::uint32_t number(const MeetingPoint& p) const {
        if (p.v == MeetingPoint::none) return p.u;
        return numbers_[static_cast<std::size_t>(std::ranges::lower_bound(keys_, key(p), {}, key) -
                                                 keys_.begin())];
    }

private:
    static std::tuple<std::uint32_t, std::uint32_t, std::uint32_t> key(const MeetingPoint& p) {
        return {p.u, p.v, p.face};
    }
    static Exact::Point_3 construct(const TriangleSoup& soup, const ExactPoints& at,
                                    const MeetingPoint& p) {
        const Corners& face = soup.triangles[p.face].vertices;
        return Exact().construct_plane_line_intersection_point_3_object()(
            at[face[0]], at[face[1]], at[face[2]], at[p.u], at[p.v]);
    }

    std::vector<MeetingPoint> keys_;
    std::vector<std::uint32_t> numbers_;
};

bool has_corner(const Corners& corners, std::uint32_t number) {
    return std::ranges::find(corners, number) != corners.end();
}

/// Walls of two materials have two triangles on the same vertices, which have to be cut alike.
void join_alike(const TriangleSoup& soup, const std::vector<char>& is_cut, DisjointSets& clusters) {
    std::vector<std::pair<Corners, std::uint32_t>> cut;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (!is_cut[t]) continue;
        cut.emplace_back(soup.triangles[t].vertices, t);
        std::ranges::sort(cut.back().first);
    }
    std::ranges::sort(cut);
    for (std::size_t i = 1; i < cut.size(); ++i)
        if (cut[i].first == cut[i - 1].first) clusters.join(cut[i].second, cut[i - 1].second);
}

/// What has to be arranged: for every triangle that is cut, alone or with those it overlaps.
std::vector<PlaneInput> gather_planes(const TriangleSoup& soup,
                                      const std::vector<MeetingPair>& pairs,
                                      const std::vector<Met>& met, const Crossings& crossings,
                                      const ExactPoints& points) {
    const std::size_t n = soup.triangles.size();
    DisjointSets clusters(n);  // of triangles that overlap each other
    std::vector<char> is_cut(n);
    for (const MeetingPair& pair : pairs) {
        if (pair.kind != Meeting::overlap) continue;
        clusters.join(pair.a, pair.b);
        is_cut[pair.a] = is_cut[pair.b] = 1;
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> point_of;  // triangle, point
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> segment_of;
    std::vector<std::uint32_t> numbers;
    for (const Met& m : met) {
        numbers.clear();
        for (const MeetingPoint& p : m.points) numbers.push_back(crossings.number(p));
        std::ranges::sort(numbers);
        numbers.erase(std::ranges::unique(numbers).begin(), numbers.end());
        if (numbers.size() > 2)  // along their line
            std::ranges::sort(numbers, [&](std::uint32_t a, std::uint32_t b) {
                return CGAL::compare_xyz(points[a], points[b]) == CGAL::SMALLER;
            });
        for (const std::uint32_t t : {m.a, m.b}) {
            const Corners& corners = soup.triangles[t].vertices;
            if (std::ranges::all_of(numbers,
                                    [&](std::uint32_t p) { return has_corner(corners, p); }))
                continue;
            is_cut[t] = 1;
            for (const std::uint32_t p : numbers) point_of.emplace_back(t, p);
            for (std::size_t i = 1; i < numbers.size(); ++i)
                segment_of.emplace_back(t, std::min(numbers[i - 1], numbers[i]),
                                        std::max(numbers[i - 1], numbers[i]));
        }
    }
    join_alike(soup, is_cut, clusters);
    std::vector<std::uint32_t> plane_of(n, MeetingPoint::none);
    std::vector<PlaneInput> planes;
    for (std::uint32_t t = 0; t < n; ++t) {
        if (!is_cut[t]) continue;
        std::uint32_t& plane = plane_of[clusters.find(t)];
        if (plane == MeetingPoint::none) {
            plane = static_cast<std::uint32_t>(planes.size());
            planes.emplace_back();
        }
        plane_of[t] = plane;
        planes[plane].members.push_back(t);
    }
    for (const auto& [t, p] : point_of) planes[plane_of[t]].points.push_back(p);
    for (const auto& [t, p, q] : segment_of) planes[plane_of[t]].segments.push_back({p, q});
    for (PlaneInput& plane : planes) {
        std::ranges::sort(plane.segments);
        plane.segments.erase(std::ranges::unique(plane.segments).begin(), plane.segments.end());
    }
    return planes;
}

/// Numbers of exact points to vertices of the soup, which grows by those that are new.
std::vector<std::uint32_t> round_points(const ExactPoints& points, const VertexRounding& round_to,
                                        TriangleSoup& soup) {
    std::unordered_map<glm::dvec3, std::uint32_t, PositionHash> vertex_at;
    vertex_at.reserve(soup.positions.size());
    const std::uint32_t before = points.vertex_count();
    std::vector<std::uint32_t> vertex_of(points.count());
    for (std::uint32_t i = 0; i < before; ++i) {
        if (points.is_flat(i)) soup.positions[i] = round_to(points.nearest(i));
        vertex_of[i] = vertex_at.emplace(soup.positions[i], i).first->second;
    }
    std::vector<glm::dvec3> made;
    for (std::uint32_t i = before; i < points.count(); ++i) {
        const glm::dvec3 p = round_to(points.nearest(i));
        const auto [at, is_new] =
            vertex_at.emplace(p, static_cast<std::uint32_t>(before + made.size()));
        if (is_new) made.push_back(p);
        vertex_of[i] = at->second;
    }
    soup.positions.insert(soup.positions.end(), made.begin(), made.end());
    return vertex_of;
}

bool is_whole(const Corners& triangle, const Corners& part) {
    return std::ranges::all_of(part, [&](std::uint32_t v) { return has_corner(triangle, v); });
}

/// Puts parts in the place of what they are parts of.
void replace(TriangleSoup& soup, const std::vector<PlanePart>& parts,
             const std::vector<std::uint32_t>& vertex_of, Resolution& resolution) {
    for (SoupTriangle& t : soup.triangles)
        for (std::uint32_t& v : t.vertices) v = vertex_of[v];
    std::vector<SoupTriangle> triangles;
    std::vector<std::array<glm::vec2, 3>> uvs;
    auto part = parts.begin();
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (part == parts.end() || part->member != t) {
            triangles.push_back(soup.triangles[t]);
            if (!soup.uvs.empty()) uvs.push_back(soup.uvs[t]);
            continue;
        }
        const auto after =
            std::find_if(part, parts.end(), [&](const PlanePart& p) { return p.member != t; });
        if (after - part == 1 && is_whole(soup.triangles[t].vertices, part->corners)) {
            triangles.push_back(soup.triangles[t]);
            if (!soup.uvs.empty()) uvs.push_back(soup.uvs[t]);
            part = after;
            continue;
        }
        ++resolution.faces_cut;
        for (; part != after; ++part) {
            const Corners& c = part->corners;
            if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;  // by rounding
            ++resolution.faces_made;
            triangles.push_back(soup.triangles[t]);
            triangles.back().vertices = c;
            if (!soup.uvs.empty()) uvs.push_back(uvs_of_part(soup, t, c));
        }
    }
    soup.triangles = std::move(triangles);
    soup.uvs = std::move(uvs);
}

}  // namespace

Resolution resolve_intersections(TriangleSoup& soup, const std::vector<MeetingPair>& pairs,
                                 const FlatVertices& flat, const VertexRounding& round_to,
                                 const Workers& workers, Monitor& monitor) {
    ExactPoints points(soup, flat);
    const std::vector<Met> met = meet_again(soup, pairs, flat, workers);
    const Crossings crossings(soup, met, points, workers);
    const std::vector<PlaneInput> planes = gather_planes(soup, pairs, met, crossings, points);
    std::vector<PlaneParts> arranged(planes.size());
    workers.for_ranges(planes.size(), 8, [&](std::size_t begin, std::size_t end, int worker) {
        for (std::size_t i = begin; i < end; ++i)
            arranged[i] = arrange_plane(soup, points, planes[i]);
        if (worker == 0) monitor.progress({.phase = "repair", .done = end, .total = planes.size()});
    });
    std::vector<Exact::Point_3> made;
    for (const PlaneParts& plane : arranged)
        made.insert(made.end(), plane.made.begin(), plane.made.end());
    const std::uint32_t first_made = points.count();
    const std::vector<std::uint32_t> made_numbers = points.add(made, workers);
    const std::vector<std::uint32_t> vertex_of = round_points(points, round_to, soup);

    std::vector<PlanePart> parts;
    std::size_t before = 0;
    for (const PlaneParts& plane : arranged) {
        for (PlanePart part : plane.parts) {
            for (std::uint32_t& c : part.corners)
                c = vertex_of[c < first_made ? c : made_numbers[before + c - first_made]];
            parts.push_back(part);
        }
        before += plane.made.size();
    }
    std::ranges::stable_sort(parts, {}, &PlanePart::member);
    Resolution resolution;
    resolution.vertices_made = soup.positions.size() - points.vertex_count();
    replace(soup, parts, vertex_of, resolution);
    return resolution;
}

}  // namespace transillum
