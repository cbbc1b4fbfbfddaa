/// What check counts and repair mends, found once for both.
#pragma once

#include <transillum/repair/triangle_soup.h>

#include <array>
#include <cstdint>
#include <vector>

namespace transillum {

/// Vertices within `tolerance` [scene units] of an earlier one that no edge joins them to, both of
/// them on border edges: cracks. Others that are near are thin parts of a surface.
/// \returns for every vertex the one to take in its place: itself, or an earlier one that is taken
/// for itself. Vertices of one triangle are never joined.
[[nodiscard]] std::vector<std::uint32_t> find_near_vertices(const TriangleSoup& soup,
                                                            double tolerance);

/// Edges shorter than `tolerance`, between vertices in `which`: for every vertex, as above, what to
/// take in its place to collapse them. Vertices that no edges lead to from each other stay apart,
/// however near.
[[nodiscard]] std::vector<std::uint32_t> find_short_edges(const TriangleSoup& soup,
                                                          const std::vector<bool>& which,
                                                          double tolerance);

enum class FaceFault : std::uint8_t {
    none,
    repeated_index,
    zero_area,
    duplicate,
    opposite,
    back  ///< a duplicate that reflects from its back, where the face to keep is black
};

struct FaultyFace {
    FaceFault fault = FaceFault::none;
    std::uint32_t first = 0;  ///< of a duplicate, opposite or back: the face to keep
};

/// One entry a triangle. Zero area: three vertices exactly on one line, or so nearly that the cross
/// product rounds to nothing. Of faces on the same three vertices, wound alike, an emitting one is
/// kept before others, then one whose back emits, then one whose back reflects, then the earliest;
/// `opposite` needs the same material on both, others are walls of two materials and are told as
/// `none`. Where the back of what is kept is black, no face is wound the other way and a duplicate
/// that emits nothing reflects from its back, the first such is told as `back`: turned, it is the
/// other side of a wall of two materials.
[[nodiscard]] std::vector<FaultyFace> find_faulty_faces(const TriangleSoup& soup,
                                                        const Scene& scene);

/// Pairs of faces on the same three vertices, wound against each other, of two materials: of each
/// winding the face that find_faulty_faces keeps. By the earlier, then the later.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> find_two_material_walls(
    const TriangleSoup& soup, const Scene& scene);

/// A vertex within the tolerance of the inside of an edge that has one face only, and not a corner
/// of that face; the vertex is itself on such an edge. Inside: further than the tolerance from both
/// ends.
struct TJunction {
    std::uint32_t triangle = 0;
    std::uint32_t edge = 0;  ///< from corner `edge` to the next
    std::uint32_t vertex = 0;
    double parameter = 0.0;  ///< along the edge, in (0, 1)
};

/// By triangle, edge and parameter. \pre no faulty faces
[[nodiscard]] std::vector<TJunction> find_t_junctions(const TriangleSoup& soup, double tolerance);

struct Flips {
    std::vector<bool> turn;             ///< one a triangle
    std::vector<bool> non_orientable;   ///< part of a component that has no such orientation
    std::vector<bool> emits_both_ways;  ///< part of one that emitters keep from it
};

/// Which triangles to turn so that all that hang together by edges of two faces run alike. Of the
/// two ways, the one that keeps more of the area of what emits from its front alone, as turning it
/// would change the light; such an emitter on the other way keeps the component as it is. Without
/// emitters, the way that keeps more of the area; where less than three fifths agree, closed
/// components turn outwards. Components that are consistent or non-orientable are never turned.
/// What repeats a vertex hangs on nothing.
[[nodiscard]] Flips find_flips(const TriangleSoup& soup, const Scene& scene);

}  // namespace transillum
