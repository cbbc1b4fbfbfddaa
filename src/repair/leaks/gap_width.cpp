#include "repair/leaks/gap_width.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

namespace transillum {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Nearest {
    glm::dvec3 on_edge, on_path;
    double distance = infinity;
};

/// Closest points of two segments (Ericson, Real-Time Collision Detection, 5.1.9).
void approach(const glm::dvec3& p, const glm::dvec3& along_p, const glm::dvec3& q,
              const glm::dvec3& along_q, Nearest& best) {
    const glm::dvec3 r = p - q;
    const double a = glm::dot(along_p, along_p), e = glm::dot(along_q, along_q);
    const double b = glm::dot(along_p, along_q), c = glm::dot(along_p, r), f = glm::dot(along_q, r);
    const double across = a * e - b * b;
    double s = across > 1e-24 * a * e ? std::clamp((b * f - c * e) / across, 0.0, 1.0) : 0.5;
    double t = e > 0.0 ? (b * s + f) / e : 0.0;
    if (t < 0.0 || t > 1.0) {
        t = std::clamp(t, 0.0, 1.0);
        s = a > 0.0 ? std::clamp((b * t - c) / a, 0.0, 1.0) : 0.0;
    }
    const glm::dvec3 on_p = p + s * along_p, on_q = q + t * along_q;
    const double distance = glm::length(on_p - on_q);
    if (distance < best.distance) best = {on_p, on_q, distance};
}

/// The plane across an edge at a point of it: first axis away from the edge's face.
struct Across {
    glm::dvec3 origin, along, outward, upward;

    [[nodiscard]] glm::dvec2 flat(const glm::dvec3& p) const {
        return {glm::dot(p - origin, outward), glm::dot(p - origin, upward)};
    }
};

/// A sector of the plane around a direction.
struct Sector {
    glm::dvec2 direction;
    double half_angle;  ///< at most pi / 2
};

/// Keeps the part of a segment where `inside` is not negative, but for rounding: an edge straight
/// above another, as of a lid that is flush, lies on the sector's border.
bool clip(glm::dvec2& from, glm::dvec2& to, const glm::dvec2& inside) {
    const double rounding = 1e-12 * std::max(glm::length(from), glm::length(to));
    const double a = glm::dot(from, inside) + rounding, b = glm::dot(to, inside) + rounding;
    if (a < 0.0 && b < 0.0) return false;
    if (a < 0.0) from += (to - from) * (a / (a - b));
    if (b < 0.0) to += (from - to) * (b / (b - a));
    return true;
}

/// Distance from the origin to the part of a segment within the sector.
double distance_within(glm::dvec2 from, glm::dvec2 to, const Sector& sector) {
    const glm::dvec2& d = sector.direction;
    const glm::dvec2 left(-d.y, d.x);
    const double s = std::sin(sector.half_angle), c = std::cos(sector.half_angle);
    if (!clip(from, to, s * d + c * left) || !clip(from, to, s * d - c * left)) return infinity;
    const glm::dvec2 along = to - from;
    const double squared = glm::dot(along, along);
    const double t = squared > 0.0 ? std::clamp(-glm::dot(from, along) / squared, 0.0, 1.0) : 0.0;
    return glm::length(from + t * along);
}

/// To the nearest part of a triangle that the plane cuts.
double distance_to(const TriangleSoup& soup, std::uint32_t triangle, const Across& plane,
                   const Sector& sector) {
    std::array<glm::dvec3, 3> corner;
    std::array<double, 3> height{};
    for (int i = 0; i < 3; ++i) {
        corner[i] = soup.positions[soup.triangles[triangle].vertices[i]];
        height[i] = glm::dot(corner[i] - plane.origin, plane.along);
    }
    const auto [low, high] = std::ranges::minmax(height);
    if (low > 0.0 || high < 0.0) return infinity;
    double nearest = infinity;
    std::array<glm::dvec2, 3> cut;
    int cuts = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (height[i] == 0.0 && height[j] == 0.0)
            nearest = std::min(
                nearest, distance_within(plane.flat(corner[i]), plane.flat(corner[j]), sector));
        else if ((height[i] <= 0.0) != (height[j] <= 0.0))
            cut[cuts++] = plane.flat(corner[i] + (corner[j] - corner[i]) *
                                                     (height[i] / (height[i] - height[j])));
    }
    if (cuts == 2) nearest = std::min(nearest, distance_within(cut[0], cut[1], sector));
    return nearest;
}

bool shares_vertex(const TriangleSoup& soup, std::uint32_t triangle, std::uint32_t a,
                   std::uint32_t b) {
    return std::ranges::any_of(soup.triangles[triangle].vertices,
                               [&](std::uint32_t v) { return v == a || v == b; });
}

Nearest approach(const TriangleSoup& soup, const SideGraph::BorderEdge& edge,
                 std::span<const glm::dvec3> path) {
    const auto& v = soup.triangles[edge.triangle].vertices;
    const glm::dvec3& from = soup.positions[v[edge.corner]];
    const glm::dvec3 along = soup.positions[v[(edge.corner + 1) % 3]] - from;
    Nearest nearest;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
        approach(from, along, path[i], path[i + 1] - path[i], nearest);
    return nearest;
}

/// How wide the gap is that the path passes at an edge, as far as the triangles tell that `visit`
/// calls its argument with; infinite where it passes none.
template <class Visit>
double gap_at(const TriangleSoup& soup, const SideGraph::BorderEdge& edge, const Nearest& pass,
              double touching, const Visit& visit) {
    const auto& v = soup.triangles[edge.triangle].vertices;
    const std::uint32_t a = v[edge.corner], b = v[(edge.corner + 1) % 3];
    const glm::dvec3 along = glm::normalize(soup.positions[b] - soup.positions[a]);
    const glm::dvec3 normal = glm::normalize(area_vector(soup, edge.triangle));
    const Across plane{pass.on_edge, along, glm::cross(along, normal), normal};
    Sector sector{{1.0, 0.0}, std::numbers::pi / 2.0};
    if (pass.distance > touching) {
        const glm::dvec2 to_path = plane.flat(pass.on_path);
        const double length = glm::length(to_path);
        // Over an end of the edge, other edges are passed more closely.
        if (to_path.x < -1e-9 * length || length < 0.5 * pass.distance) return infinity;
        sector = {to_path / length, std::numbers::pi / 3.0};
    }
    double width = infinity;
    visit([&](std::uint32_t t) {
        if (!shares_vertex(soup, t, a, b))
            width = std::min(width, distance_to(soup, t, plane, sector));
    });
    return width < 0.999 * pass.distance ? infinity : width;  // else it is before the path
}

}  // namespace

Gap narrowest_gap(const TriangleSoup& soup, const TriangleTree& tree,
                  const std::vector<SideGraph::BorderEdge>& border,
                  std::span<const glm::dvec3> path, double limit, double touching) {
    constexpr std::size_t most_measured = 16;
    std::vector<std::pair<Nearest, std::size_t>> passes;
    for (std::size_t i = 0; i < border.size(); ++i)
        passes.emplace_back(approach(soup, border[i], path), i);
    std::ranges::sort(passes, [](const auto& a, const auto& b) {
        return std::tie(a.first.distance, a.second) < std::tie(b.first.distance, b.second);
    });
    Gap narrowest{infinity, {}};
    const auto keep = [&](double width, const Nearest& pass) {
        if (width < narrowest.width) narrowest = {width, pass.on_path};
    };
    for (const auto& [pass, edge] : passes) {
        if (pass.distance >= std::min(narrowest.width, limit)) break;
        const auto near = tree.near_to(pass.on_edge, std::min(narrowest.width, limit));
        keep(gap_at(soup, border[edge], pass, touching,
                    [&](const auto& look) { std::ranges::for_each(near, look); }),
             pass);
    }
    if (narrowest.width < limit) return narrowest;
    for (std::size_t i = 0; i < std::min(passes.size(), most_measured); ++i) {
        const auto& [pass, edge] = passes[i];
        keep(gap_at(soup, border[edge], pass, touching,
                    [&](const auto& look) {
                        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) look(t);
                    }),
             pass);
    }
    return narrowest;
}

}  // namespace transillum
