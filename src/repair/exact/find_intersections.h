/// Pairs of triangles that meet where they should not: by exact predicates on the doubles.
#pragma once

#include <transillum/base/parallel.h>
#include <transillum/repair/triangle_soup.h>

#include <vector>

namespace transillum {

enum class Meeting : std::uint8_t {
    touching,  ///< in points or along edges only, but not (only) in shared vertices and edges: a
               ///< vertex on a face or edge, edges that cross or run along each other
    crossing,  ///< one passes through the other
    overlap    ///< they share area of one plane
};

struct MeetingPair {
    std::uint32_t a = 0, b = 0;  ///< triangles, a < b
    Meeting kind{};

    bool operator==(const MeetingPair&) const = default;
};

struct FlatVertices;

/// All of them, by a and b; where there are more than `most`, some that are. \pre the soup has no
/// triangle without area. \param flat see flatten.h; null: none
[[nodiscard]] std::vector<MeetingPair> find_intersections(const TriangleSoup& soup,
                                                          const Workers& workers,
                                                          std::size_t most = SIZE_MAX,
                                                          const FlatVertices* flat = nullptr);

}  // namespace transillum
