/// Faces with others close behind their backs.
#pragma once

#include "repair/exact/find_intersections.h"

namespace transillum {

struct ThinWall {
    std::uint32_t triangle = 0, behind = 0;
    double thickness = 0.0;  ///< from the triangle's centre to the other, along the normal
};

/// At most one a triangle, the thinnest; by triangle. Only faces that run about alike count, and
/// none that share a vertex or are told as meeting.
/// \pre every triangle has area; `meetings` as find_intersections gives them
[[nodiscard]] std::vector<ThinWall> find_thin_walls(const TriangleSoup& soup, double thickness,
                                                    const std::vector<MeetingPair>& meetings,
                                                    const Workers& workers);

}  // namespace transillum
