/// A scene's polygons as triangles on shared vertices: what is checked and repaired, and what the
/// surface is built from.
#pragma once

#include <transillum/scene/scene.h>

#include <array>
#include <cstdint>
#include <vector>

namespace transillum {

struct SoupTriangle {
    std::array<std::uint32_t, 3> vertices{};  ///< indices into TriangleSoup::positions
    std::uint32_t polygon = 0;                ///< of Scene::polygons, which this is a part of
    bool both_sides = false;  ///< stands for one wound the other way too, of the same material

    bool operator==(const SoupTriangle&) const = default;
};

/// Triangles may be without area, repeat vertices, cross and overlap.
struct TriangleSoup {
    std::vector<glm::dvec3> positions;  ///< finite; no two are equal
    std::vector<SoupTriangle> triangles;
    std::vector<std::array<glm::vec2, 3>> uvs;  ///< one a triangle, or empty
};

/// What was met on the way from the polygons.
struct SoupCounts {
    std::uint64_t vertices = 0;      ///< positions that polygons use
    std::uint64_t welded = 0;        ///< of these, at the place of an earlier one
    std::uint64_t without_area = 0;  ///< polygons that give no triangle
};

/// Vertices at one place become one, in the order of the scene; unused ones are left out. Polygons
/// are triangulated (constrained Delaunay, so concave ones and seams come out right).
/// \throws InputError on a coordinate that is no finite number.
[[nodiscard]] TriangleSoup make_soup(const Scene& scene, SoupCounts* counts = nullptr);

/// Twice the area vector; its direction is the front's.
[[nodiscard]] glm::dvec3 area_vector(const TriangleSoup& soup, std::uint32_t triangle);

/// False where its vertices are on one line (exactly), or so nearly that the cross product rounds
/// to nothing and there is no normal.
[[nodiscard]] bool has_area(const TriangleSoup& soup, std::uint32_t triangle);

/// Length of the diagonal of the box around all vertices; 0 without any.
[[nodiscard]] double diagonal_of(const TriangleSoup& soup);

}  // namespace transillum
