#include "repair/leaks/gap_width.h"

#include "repair/leaks/find_passes.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace transillum {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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

/// What lies ahead of an edge, past the path.
class View {
public:
    View(const TriangleSoup& soup, const SideGraph::BorderEdge& edge, const Pass& pass,
         double touching)
        : soup_(soup), pass_(pass) {
        const auto& v = soup.triangles[edge.triangle].vertices;
        a_ = v[edge.corner];
        b_ = v[(edge.corner + 1) % 3];
        const glm::dvec3 along = glm::normalize(soup.positions[b_] - soup.positions[a_]);
        const glm::dvec3 normal = glm::normalize(area_vector(soup, edge.triangle));
        plane_ = {pass.on_edge, along, glm::cross(along, normal), normal};
        if (pass.distance <= touching) return;
        const glm::dvec2 to_path = plane_.flat(pass.on_path);
        const double length = glm::length(to_path);
        // Over an end of the edge, other edges are passed more closely.
        is_empty_ = to_path.x < -1e-9 * length || length < 0.5 * pass.distance;
        sector_ = {to_path / length, std::numbers::pi / 3.0};
    }

    [[nodiscard]] const Pass& pass() const { return pass_; }
    /// Does the path not pass the edge?
    [[nodiscard]] bool is_empty() const { return is_empty_; }
    [[nodiscard]] double distance_to(std::uint32_t triangle) const {
        return shares_vertex(soup_, triangle, a_, b_)
                   ? infinity
                   : transillum::distance_to(soup_, triangle, plane_, sector_);
    }
    /// How wide the gap is, by the nearest that is ahead; infinite where that is before the path.
    [[nodiscard]] double width(double nearest) const {
        return nearest < 0.999 * pass_.distance ? infinity : nearest;
    }

private:
    const TriangleSoup& soup_;
    Pass pass_;
    std::uint32_t a_ = 0, b_ = 0;
    Across plane_{};
    Sector sector_{{1.0, 0.0}, std::numbers::pi / 2.0};
    bool is_empty_ = false;
};

/// Of each view, the distance of the nearest of all triangles.
std::vector<double> look_at_all(const TriangleSoup& soup, const std::vector<View>& views,
                                const Workers& workers) {
    std::vector<std::vector<double>> nearest(static_cast<std::size_t>(workers.count()),
                                             std::vector<double>(views.size(), infinity));
    workers.for_ranges(soup.triangles.size(), 1024, [&](std::size_t begin, std::size_t end, int w) {
        std::vector<double>& mine = nearest[static_cast<std::size_t>(w)];
        for (std::size_t t = begin; t < end; ++t)
            for (std::size_t v = 0; v < views.size(); ++v)
                mine[v] = std::min(mine[v], views[v].distance_to(static_cast<std::uint32_t>(t)));
    });
    for (const std::vector<double>& some : nearest)
        std::ranges::transform(some, nearest.front(), nearest.front().begin(),
                               [](double a, double b) { return std::min(a, b); });
    return nearest.front();
}

}  // namespace

Gap narrowest_gap(const TriangleSoup& soup, const TriangleTree& tree,
                  const std::vector<SideGraph::BorderEdge>& border,
                  std::span<const glm::dvec3> path, double limit, double touching,
                  const Workers& workers) {
    constexpr std::size_t most_measured = 16;
    const std::vector<Pass> passes = find_passes(soup, border, path, workers);
    Gap narrowest{infinity, {}};
    const auto keep = [&](const View& view, double nearest) {
        const double width = view.width(nearest);
        if (width < narrowest.width) narrowest = {width, view.pass().on_path};
    };
    for (const Pass& pass : passes) {
        const double reach = std::min(narrowest.width, limit);
        if (pass.distance >= reach) break;
        const View view(soup, border[pass.edge], pass, touching);
        if (view.is_empty()) continue;
        double nearest = infinity;
        for (const std::uint32_t t : tree.near_to(pass.on_edge, reach))
            nearest = std::min(nearest, view.distance_to(t));
        keep(view, nearest);
    }
    if (narrowest.width < limit) return narrowest;
    std::vector<View> views;
    for (const Pass& pass : std::span(passes).first(std::min(passes.size(), most_measured))) {
        views.emplace_back(soup, border[pass.edge], pass, touching);
        if (views.back().is_empty()) views.pop_back();
    }
    const std::vector<double> nearest = look_at_all(soup, views, workers);
    for (std::size_t v = 0; v < views.size(); ++v) keep(views[v], nearest[v]);
    return narrowest;
}

}  // namespace transillum
