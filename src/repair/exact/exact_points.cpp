#include "repair/exact/exact_points.h"

#include <cmath>
#include <limits>

namespace transillum {

namespace {

double nearest_double(const Exact::FT& lazy) {
    const auto& x = CGAL::exact(lazy);
    const double truncated = CGAL::to_double(x);  // at most one double off
    double best = truncated;
    for (const double limit :
         {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}) {
        using Number = std::decay_t<decltype(x)>;
        const double next = std::nextafter(truncated, limit);
        if (!std::isfinite(next)) continue;
        const Number gain = CGAL::abs(x - Number(best)) - CGAL::abs(x - Number(next));
        if (gain > 0 || (gain == 0 && next > best)) best = next;
    }
    return best + 0.0;
}

}  // namespace

glm::dvec3 nearest_doubles(const Exact::Point_3& p) {
    p.exact();  // lets go of what it was constructed from
    return {nearest_double(p.x()), nearest_double(p.y()), nearest_double(p.z())};
}

ExactPoints::ExactPoints(const TriangleSoup& soup, const FlatVertices& flat)
    : soup_(soup), flat_(flat), vertex_count_(static_cast<std::uint32_t>(soup.positions.size())) {
    numbers_.reserve(soup.positions.size());
    for (std::uint32_t i = 0; i < soup.positions.size(); ++i) numbers_.emplace(nearest(i), i);
}

std::vector<std::uint32_t> ExactPoints::add(const std::vector<Exact::Point_3>& points,
                                            const Workers& workers) {
    std::vector<glm::dvec3> nearest(points.size());
    workers.for_ranges(points.size(), 64, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) nearest[i] = nearest_doubles(points[i]);
    });
    std::vector<std::uint32_t> numbers;
    numbers.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) numbers.push_back(add(points[i], nearest[i]));
    return numbers;
}

std::uint32_t ExactPoints::add(const Exact::Point_3& point, const glm::dvec3& nearest) {
    const auto [begin, end] = numbers_.equal_range(nearest);
    for (auto at = begin; at != end; ++at)
        if ((*this)[at->second] == point) return at->second;
    const std::uint32_t number = count();
    added_.push_back(point);
    nearest_.push_back(nearest);
    numbers_.emplace(nearest, number);
    return number;
}

}  // namespace transillum
