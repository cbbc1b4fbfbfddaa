/// Points with exact coordinates (CGAL's exact constructions), numbered so that equal points have
/// equal numbers.
#pragma once

#include "repair/exact/flatten.h"
#include "repair/position_hash.h"

#include <transillum/base/parallel.h>
#include <transillum/repair/snap_grid.h>
#include <transillum/repair/triangle_soup.h>

#include <unordered_map>

namespace transillum {

/// The double nearest to each coordinate; the upper of two.
[[nodiscard]] glm::dvec3 nearest_doubles(const Exact::Point_3& p);

/// The first numbers are the vertices of a soup; what is added follows.
class ExactPoints {
public:
    ExactPoints(const TriangleSoup& soup, const FlatVertices& flat);

    [[nodiscard]] Exact::Point_3 operator[](std::uint32_t number) const {
        if (number >= vertex_count()) return added_[number - vertex_count()];
        const auto moved = flat_.positions.find(number);
        return moved != flat_.positions.end() ? moved->second
                                              : exact_point(soup_.positions[number]);
    }
    [[nodiscard]] bool is_flat(std::uint32_t number) const {
        return flat_.positions.contains(number);
    }
    [[nodiscard]] glm::dvec3 nearest(std::uint32_t number) const {
        if (number >= vertex_count()) return nearest_[number - vertex_count()];
        const auto moved = flat_.positions.find(number);
        return moved != flat_.positions.end() ? nearest_doubles(moved->second)
                                              : soup_.positions[number];
    }
    [[nodiscard]] std::uint32_t vertex_count() const { return vertex_count_; }
    [[nodiscard]] std::uint32_t count() const {
        return static_cast<std::uint32_t>(vertex_count_ + added_.size());
    }
    /// The numbers of points, those of new ones in the order given.
    std::vector<std::uint32_t> add(const std::vector<Exact::Point_3>& points,
                                   const Workers& workers);

private:
    std::uint32_t add(const Exact::Point_3& point, const glm::dvec3& nearest);

    const TriangleSoup& soup_;
    const FlatVertices& flat_;
    std::uint32_t vertex_count_ = 0;  ///< of the soup, which may grow afterwards
    std::vector<Exact::Point_3> added_;
    std::vector<glm::dvec3> nearest_;
    /// By nearest double: equal points round alike, as that depends on their value alone.
    std::unordered_multimap<glm::dvec3, std::uint32_t, PositionHash> numbers_;
};

}  // namespace transillum
