#include "repair/defects/check_edges.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace transillum {

namespace {

/// One corner at a vertex: its triangle's two edges there lead to these vertices.
struct Corner {
    std::uint32_t triangle;
    std::array<std::uint32_t, 2> ends;
};

/// How many groups of them hang together by common edges.
std::size_t count_fans(std::vector<Corner>& corners) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;  // vertex, corner
    for (std::uint32_t i = 0; i < corners.size(); ++i)
        for (const std::uint32_t end : corners[i].ends) ends.emplace_back(end, i);
    std::ranges::sort(ends);
    std::vector<std::uint32_t> parent(corners.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::size_t fans = corners.size();
    for (std::size_t i = 1; i < ends.size(); ++i) {
        if (ends[i].first != ends[i - 1].first) continue;
        const std::uint32_t a = root(ends[i].second), b = root(ends[i - 1].second);
        if (a == b) continue;
        parent[std::max(a, b)] = std::min(a, b);
        --fans;
    }
    return fans;
}

void check_vertices(const TriangleSoup& soup, DefectSites& sites) {
    const VertexCorners at(soup);
    std::vector<Corner> corners;
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t v = 0; v < soup.positions.size(); ++v) {
        corners.clear();
        triangles.clear();
        for (const std::uint32_t corner : at[v]) {
            const SoupTriangle& t = soup.triangles[corner / 3];
            if (repeats_vertex(t)) continue;
            corners.push_back(
                {corner / 3, {t.vertices[(corner + 1) % 3], t.vertices[(corner + 2) % 3]}});
            triangles.push_back(corner / 3);
        }
        if (corners.size() > 1 && count_fans(corners) > 1)
            sites.add_vertex(Defect::nonmanifold_vertex, v, triangles);
    }
}

}  // namespace

void check_edges(const TriangleSoup& soup, DefectSites& sites) {
    const EdgeTable edges(soup);
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const auto uses = edges[e];
        if (uses.size() == 1)
            sites.add_edge(Defect::border_edge, uses);
        else if (uses.size() > 2)
            sites.add_edge(Defect::nonmanifold_edge, uses);
        else if (uses[0].ascending == uses[1].ascending)
            sites.add_edge(Defect::flipped_edge, uses);
    }
    check_vertices(soup, sites);
}

}  // namespace transillum
