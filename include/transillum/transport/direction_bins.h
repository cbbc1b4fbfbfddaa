/// Direction bins of the finite elements (paper §2.1, the functions d_j; §3.2 on dividing them).
///
/// The hemisphere above a side is projected onto the unit disk, and the disk mapped onto the unit
/// square by Shirley and Chiu's concentric map. Both keep projected solid angle up to a factor, so
/// the 2^level x 2^level cells of the square are bins of equal projected solid angle pi / 4^level,
/// and dividing a bin into four is the next level.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

namespace transillum {

inline constexpr int max_bin_level = 3;

[[nodiscard]] constexpr int bin_count(int level) {
    return 1 << (2 * level);
}

/// Point of the unit square that stands for a unit direction with z >= 0, and back.
[[nodiscard]] glm::vec2 square_of_direction(const glm::vec3& direction);
[[nodiscard]] glm::vec3 direction_of_square(const glm::vec2& square);

/// Row-major number of the bin that holds a point of the square.
[[nodiscard]] inline int bin_at(const glm::vec2& square, int level) {
    const int side = 1 << level;
    const auto cell = [&](float x) {
        return std::clamp(static_cast<int>(x * static_cast<float>(side)), 0, side - 1);
    };
    return cell(square.y) * side + cell(square.x);
}

/// Frame in which the bins of a side lie: third column its unit normal. Sides whose normals differ
/// little have frames that differ little, but near one direction that no axis is close to.
[[nodiscard]] glm::dmat3 bin_frame(const glm::dvec3& normal);

}  // namespace transillum
