#include "repair/part_uvs.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace transillum {

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Barycentric coordinates of a point in the plane of a triangle, as seen along its normal.
glm::dvec3 barycentric(const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double area = glm::dot(normal, normal);
    const double b1 = glm::dot(glm::cross(p - t[0], t[2] - t[0]), normal) / area;
    const double b2 = glm::dot(glm::cross(t[1] - t[0], p - t[0]), normal) / area;
    // Within it: what is cut from a needle may be beside it by more than its width.
    const glm::dvec3 b = glm::max(glm::dvec3(1.0 - b1 - b2, b1, b2), 0.0);
    const double sum = b.x + b.y + b.z;
    return sum > 0.0 ? b / sum : glm::dvec3(1.0, 0.0, 0.0);  // also where it has lost its area
}

}  // namespace

std::array<glm::vec2, 3> uvs_of_part(const TriangleSoup& soup, std::uint32_t whole,
                                     const Corners& part) {
    const Corners& corners = soup.triangles[whole].vertices;
    std::array<glm::dvec3, 3> t;
    for (int i = 0; i < 3; ++i) t[i] = soup.positions[corners[i]];
    std::array<glm::vec2, 3> uvs;
    for (int i = 0; i < 3; ++i) {
        const auto same = std::ranges::find(corners, part[i]);
        if (same != corners.end()) {
            uvs[i] = soup.uvs[whole][static_cast<std::size_t>(same - corners.begin())];
            continue;
        }
        const glm::dvec3 b = barycentric(t, soup.positions[part[i]]);
        glm::dvec2 uv(0.0);
        for (int k = 0; k < 3; ++k) uv += b[k] * glm::dvec2(soup.uvs[whole][k]);
        uvs[i] = uv;
    }
    return uvs;
}

}  // namespace transillum
