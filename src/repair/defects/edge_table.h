/// A soup's edges and vertices with their faces, by sorting.
#pragma once

#include <transillum/repair/triangle_soup.h>

#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

/// One side of a triangle: its edge from corner `side % 3` to the next.
struct EdgeUse {
    std::uint32_t low = 0, high = 0;  ///< vertices, low < high
    std::uint32_t side = 0;           ///< 3 * triangle + corner
    bool ascending = false;           ///< runs from low to high

    [[nodiscard]] std::uint32_t triangle() const { return side / 3; }
};

/// All edges by (low, high); an edge's uses are in the order of its sides. Triangles that repeat a
/// vertex have none.
class EdgeTable {
public:
    explicit EdgeTable(const TriangleSoup& soup);

    [[nodiscard]] std::uint32_t size() const {
        return static_cast<std::uint32_t>(first_.size()) - 1;
    }
    [[nodiscard]] std::span<const EdgeUse> operator[](std::uint32_t edge) const {
        return {uses_.data() + first_[edge], uses_.data() + first_[edge + 1]};
    }

private:
    std::vector<EdgeUse> uses_;
    std::vector<std::uint32_t> first_;  ///< one an edge, and the end
};

/// One entry a position: is it an end of an edge of one triangle?
[[nodiscard]] std::vector<bool> border_vertices(const TriangleSoup& soup);

/// The sides whose triangle has its corner there: for each vertex, 3 * triangle + corner.
class VertexCorners {
public:
    explicit VertexCorners(const TriangleSoup& soup);

    [[nodiscard]] std::span<const std::uint32_t> operator[](std::uint32_t vertex) const {
        return {corners_.data() + first_[vertex], corners_.data() + first_[vertex + 1]};
    }

private:
    std::vector<std::uint32_t> corners_, first_;
};

/// A triangle that names a vertex twice?
[[nodiscard]] inline bool repeats_vertex(const SoupTriangle& t) {
    const auto& v = t.vertices;
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
}

}  // namespace transillum
