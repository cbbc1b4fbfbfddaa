#include "render/lightmap/chart.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace transillum {

namespace {

/// Of the angle between a side and the one its chart began with: a texel is at most so much longer
/// on the surface than it is wide.
constexpr double least_cosine = 0.7;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(const SurfaceMesh& mesh, std::uint32_t root, std::size_t corner) {
    const auto& v = mesh.triangles[root].vertices;
    return std::minmax(v[corner], v[(corner + 1) % 3]);
}

std::uint64_t key(const Edge& edge) {
    return (static_cast<std::uint64_t>(edge.first) << 32) | edge.second;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

glm::dvec3 normal_of(const SurfaceMesh& mesh, const RootSide& side) {
    return normal_of(mesh, side.root) * (side.back ? -1.0 : 1.0);
}

/// A plane that a chart is projected on, its x along the longest edge of the first side.
class Projection {
public:
    Projection(const SurfaceMesh& mesh, const RootSide& side, double texel) : texel_(texel) {
        normal = normal_of(mesh, side);
        const auto& v = mesh.triangles[side.root].vertices;
        origin_ = mesh.positions[v[0]];
        glm::dvec3 longest(0.0);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 edge = mesh.positions[v[(i + 1) % 3]] - mesh.positions[v[i]];
            if (glm::dot(edge, edge) > glm::dot(longest, longest)) longest = edge;
        }
        x_ = glm::normalize(longest);
        y_ = glm::cross(normal, x_);
    }

    [[nodiscard]] Chart::Triangle operator()(const SurfaceMesh& mesh, const RootSide& side) const {
        Chart::Triangle triangle{side, {}};
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 from = mesh.positions[mesh.triangles[side.root].vertices[i]] - origin_;
            triangle.corners[i] = glm::dvec2(glm::dot(from, x_), glm::dot(from, y_)) / texel_;
        }
        return triangle;
    }

    glm::dvec3 normal;

private:
    glm::dvec3 origin_, x_, y_;
    double texel_;
};

/// Texels whose middle a chart covers. As long as it is a plane it can't cover one twice.
class Covered {
public:
    /// Whether a triangle of the plane, or another, is welcome after those of the chart.
    bool has_room_for(const Chart::Triangle& t, bool is_of_plane, const Chart& chart) {
        if (is_plane_ && is_of_plane) return true;
        is_plane_ = false;
        for (; entered_ < chart.triangles.size(); ++entered_) {
            const std::vector<std::uint64_t> texels = texels_of(chart.triangles[entered_]);
            covered_.insert(texels.begin(), texels.end());
        }
        return std::ranges::none_of(texels_of(t),
                                    [&](std::uint64_t k) { return covered_.contains(k); });
    }

private:
    /// Those on an edge are neither this triangle's nor its neighbour's.
    static std::vector<std::uint64_t> texels_of(const Chart::Triangle& t) {
        const auto& [a, b, c] = t.corners;
        const glm::dvec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
        const double sign = cross(b - a, c - a) < 0.0 ? -1.0 : 1.0;
        const double edge = 1e-9 * std::abs(cross(b - a, c - a));
        std::vector<std::uint64_t> texels;
        for (auto y = std::llround(low.y); y < std::llround(high.y); ++y)
            for (auto x = std::llround(low.x); x < std::llround(high.x); ++x) {
                const glm::dvec2 p(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
                if (sign * cross(b - a, p - a) > edge && sign * cross(c - b, p - b) > edge &&
                    sign * cross(a - c, p - c) > edge)
                    texels.push_back(
                        (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
                        static_cast<std::uint32_t>(y));
            }
        return texels;
    }

    std::unordered_set<std::uint64_t> covered_;
    std::size_t entered_ = 0;  ///< triangles of the chart
    bool is_plane_ = true;
};

struct Bounds {
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-low};

    /// Of a chart with `along` as its x axis.
    Bounds(const Chart& chart, const glm::dvec2& along) {
        for (const Chart::Triangle& t : chart.triangles)
            for (const glm::dvec2& p : t.corners) {
                const glm::dvec2 q = turned(p, along);
                low = glm::min(low, q);
                high = glm::max(high, q);
            }
    }
    [[nodiscard]] static glm::dvec2 turned(const glm::dvec2& p, const glm::dvec2& along) {
        return {glm::dot(p, along), cross(along, p)};
    }
    [[nodiscard]] glm::dvec2 extent() const { return high - low; }
    [[nodiscard]] double area() const { return extent().x * extent().y; }
};

/// Turns it so that one of its longest borders lies along x or y and it takes the least room, wider
/// than high, and moves it to its own corner.
void settle(Chart& chart, const SurfaceMesh& mesh) {
    constexpr std::size_t tried = 8;
    std::vector<glm::dvec2> edges{{1.0, 0.0}};
    for (const ChartBorder& border : borders_of(chart, mesh)) {
        const auto& corners = chart.triangles[border.triangle].corners;
        const auto from = static_cast<std::size_t>(border.corner);
        edges.push_back(corners[(from + 1) % 3] - corners[from]);
    }
    const std::size_t count = std::min(tried, edges.size());
    std::ranges::partial_sort(edges, edges.begin() + static_cast<std::ptrdiff_t>(count),
                              std::greater(), [](const glm::dvec2& e) { return glm::dot(e, e); });
    glm::dvec2 along(1.0, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const double length = glm::length(edges[i]);
        if (length == 0.0) continue;
        const glm::dvec2 edge = edges[i] / length;
        // Room is saved, not rounding.
        if (Bounds(chart, edge).area() < 0.999 * Bounds(chart, along).area()) along = edge;
    }
    if (const glm::dvec2 extent = Bounds(chart, along).extent(); extent.y > extent.x)
        along = {-along.y, along.x};
    const Bounds bounds(chart, along);
    for (Chart::Triangle& t : chart.triangles)
        for (glm::dvec2& p : t.corners)
            p = Bounds::turned(p, along) - bounds.low + glm::dvec2(Chart::padding);
    const glm::ivec2 texels(glm::ceil(bounds.extent()));
    chart.width = texels.x + 2 * Chart::padding;
    chart.height = texels.y + 2 * Chart::padding;
}

}  // namespace

ChartMaker::ChartMaker(const SurfaceMesh& mesh, const std::vector<RootSide>& sides)
    : mesh_(mesh), sides_(sides), order_(sides.size()) {
    for (std::uint32_t i = 0; i < sides.size(); ++i)
        for (std::size_t corner = 0; corner < 3; ++corner)
            sides_at_[key(edge_of(mesh, sides[i].root, corner))].push_back(i);
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::stable_sort(order_, std::greater(),
                             [&](std::uint32_t i) { return area_of(mesh_, sides_[i].root); });
}

std::vector<Chart> ChartMaker::make(double texel) const {
    std::vector<std::uint8_t> is_taken(sides_.size(), 0);
    std::vector<Chart> charts;
    for (const std::uint32_t first : order_)
        if (!is_taken[first]) charts.push_back(grow(first, texel, is_taken));
    return charts;
}

Chart ChartMaker::grow(std::uint32_t first, double texel,
                       std::vector<std::uint8_t>& is_taken) const {
    constexpr double rounding = 1e-12;
    const Projection project(mesh_, sides_[first], texel);
    Chart chart;
    chart.object = mesh_.triangles[sides_[first].root].object;
    Covered covered;
    std::deque<std::uint32_t> reached{first};
    while (!reached.empty()) {
        const std::uint32_t side = reached.front();
        reached.pop_front();
        if (is_taken[side]) continue;
        const Chart::Triangle triangle = project(mesh_, sides_[side]);
        const bool is_of_plane =
            glm::dot(normal_of(mesh_, sides_[side]), project.normal) > 1.0 - rounding;
        if (!covered.has_room_for(triangle, is_of_plane, chart)) continue;
        is_taken[side] = 1;
        chart.triangles.push_back(triangle);
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (const std::uint32_t next :
                 sides_at_.at(key(edge_of(mesh_, sides_[side].root, corner))))
                if (!is_taken[next] && belongs(next, chart.object, project.normal))
                    reached.push_back(next);
    }
    settle(chart, mesh_);
    return chart;
}

bool ChartMaker::belongs(std::uint32_t side, std::uint32_t object, const glm::dvec3& normal) const {
    return mesh_.triangles[sides_[side].root].object == object &&
           glm::dot(normal_of(mesh_, sides_[side]), normal) >= least_cosine;
}

bool pack_charts(std::vector<Chart>& charts, int size) {
    std::vector<std::uint32_t> order(charts.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, std::greater(),
                             [&](std::uint32_t i) { return charts[i].height; });
    int x = 0, y = 0, row = 0;
    for (const std::uint32_t i : order) {
        Chart& chart = charts[i];
        if (x + chart.width > size) {
            x = 0;
            y += row;
            row = 0;
        }
        if (chart.width > size || y + chart.height > size) return false;
        chart.x = x;
        chart.y = y;
        x += chart.width;
        row = std::max(row, chart.height);
    }
    return true;
}

std::vector<ChartBorder> borders_of(const Chart& chart, const SurfaceMesh& mesh) {
    std::map<Edge, int> count;
    for (const Chart::Triangle& t : chart.triangles)
        for (std::size_t corner = 0; corner < 3; ++corner)
            ++count[edge_of(mesh, t.side.root, corner)];
    std::vector<ChartBorder> borders;
    for (std::uint32_t i = 0; i < chart.triangles.size(); ++i)
        for (int corner = 0; corner < 3; ++corner)
            if (count.at(edge_of(mesh, chart.triangles[i].side.root,
                                 static_cast<std::size_t>(corner))) == 1)
                borders.push_back({i, corner});
    return borders;
}

}  // namespace transillum
