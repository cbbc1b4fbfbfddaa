/// Texture coordinates of what a triangle is cut into.
#pragma once

#include <transillum/repair/triangle_soup.h>

namespace transillum {

/// Of a triangle in the plane of another (or next to it): its corners' are kept, others are
/// interpolated. \pre the soup has UVs
[[nodiscard]] std::array<glm::vec2, 3> uvs_of_part(const TriangleSoup& soup, std::uint32_t whole,
                                                   const std::array<std::uint32_t, 3>& part);

}  // namespace transillum
