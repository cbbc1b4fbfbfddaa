/// What can be wrong with a mesh, and where it is.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace transillum {

/// In the order of reports. Thresholds are in CheckOptions.
enum class Defect : std::uint8_t {
    duplicate_vertex,     ///< at exactly the place of an earlier one
    near_vertex,          ///< within the tolerance of an earlier one that no edge joins it to, both
                          ///< on border edges
    repeated_index,       ///< a triangle that names a vertex twice
    zero_area,            ///< three vertices on one line
    needle,               ///< thinner than the threshold, relative to its longest edge
    duplicate_face,       ///< on the vertices of an earlier one, wound alike
    opposite_face,        ///< the same wound the other way, of one material: one of them is enough
    two_material_wall,    ///< the same of two materials: a wall with a side of each
    nonmanifold_edge,     ///< of three faces or more
    nonmanifold_vertex,   ///< where several fans of faces meet in nothing but the vertex
    flipped_edge,         ///< whose two faces run along it the same way
    border_edge,          ///< of one face
    t_junction,           ///< a vertex within the tolerance of the inside of a border edge
    self_intersection,    ///< two faces of one object meet outside their shared vertices
    object_intersection,  ///< the same of two objects
    coplanar_overlap,     ///< two faces share area of one plane
    non_orientable,       ///< a component that has no consistent orientation (Moebius)
    inside_out,           ///< a closed component that encloses a negative volume
    thin_wall,            ///< a face with another close behind its back
    leak                  ///< a narrow way from outside to what the lights or cameras see
};
inline constexpr std::size_t defect_count = 20;

/// As reports and files spell it: "duplicate-vertex".
[[nodiscard]] std::string_view name_of(Defect defect);
/// One line for a person: what it is and what it does to a bake.
[[nodiscard]] std::string_view describe(Defect defect);
/// Does it spoil a bake? The others are told, and are no reason to fail.
[[nodiscard]] bool is_harmful(Defect defect);

using DefectCounts = std::array<std::uint64_t, defect_count>;

/// Of near vertices and T-junctions, over the scene's diagonal. Up to the most, few vertices have
/// many near them: each is compared with all of these.
inline constexpr double usual_tolerance = 4e-7, most_tolerance = 1e-3;

/// Where a defect is: one vertex, an edge of two, or a triangle; nowhere (0) for polygons that give
/// no triangle.
struct DefectSite {
    Defect defect{};
    std::uint8_t vertex_count = 1;
    std::array<std::uint32_t, 3> vertices{};  ///< of TriangleSoup::positions
    std::uint32_t polygon = 0;                ///< one that has it
    std::uint32_t other = 0;                  ///< the other polygon of a pair, else the same
};

}  // namespace transillum
