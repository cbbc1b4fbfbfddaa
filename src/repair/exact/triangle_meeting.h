/// How two triangles meet, by exact predicates on their coordinates (CGAL, filtered); on exact
/// coordinates where vertices are flattened.
#pragma once

#include "repair/exact/find_intersections.h"

#include <optional>

namespace transillum {

/// A point where two triangles meet, said by what it is the meeting of, so that it can be
/// constructed exactly: a vertex of the soup, or an edge that crosses the plane of a triangle.
struct MeetingPoint {
    static constexpr std::uint32_t none = 0xffffffffu;

    std::uint32_t u = 0;
    std::uint32_t v = none;     ///< of an edge (u, v), u < v; none: the vertex u
    std::uint32_t face = none;  ///< that the edge crosses

    bool operator==(const MeetingPoint&) const = default;
};

struct TriangleMeeting {
    Meeting kind{};
    /// Corners of what they share, with the shared vertex where there is one; points that edges
    /// make in two ways may come twice. Of triangles that are not of one plane, they are on a line.
    /// Empty where area is shared.
    std::vector<MeetingPoint> points;
};

/// Empty where they don't meet, or only in shared vertices and edges. \pre as find_intersections
[[nodiscard]] std::optional<TriangleMeeting> meet(const TriangleSoup& soup, std::uint32_t a,
                                                  std::uint32_t b,
                                                  const FlatVertices* flat = nullptr);

}  // namespace transillum
