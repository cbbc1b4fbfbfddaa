#include "repair/coarsen.h"

#include "repair/position_hash.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

namespace transillum {

double coarsen(TriangleSoup& soup, const std::vector<MeetingPair>& pairs, double spacing) {
    const auto cell_of = [&](const glm::dvec3& p) {
        return glm::dvec3(std::nearbyint(p.x / spacing), std::nearbyint(p.y / spacing),
                          std::nearbyint(p.z / spacing)) *
                   spacing +
               0.0;
    };
    std::unordered_set<glm::dvec3, PositionHash> cells;
    for (const MeetingPair& pair : pairs)
        for (const std::uint32_t t : {pair.a, pair.b})
            for (const std::uint32_t v : soup.triangles[t].vertices)
                cells.insert(cell_of(soup.positions[v]));
    double largest = 0.0;
    std::unordered_map<glm::dvec3, std::uint32_t, PositionHash> vertex_in;
    std::vector<std::uint32_t> target(soup.positions.size());
    std::iota(target.begin(), target.end(), 0u);
    for (std::uint32_t v = 0; v < target.size(); ++v) {
        glm::dvec3& p = soup.positions[v];
        const glm::dvec3 cell = cell_of(p);
        if (!cells.contains(cell)) continue;
        largest = std::max(largest, glm::length(cell - p));
        p = cell;
        target[v] = vertex_in.emplace(cell, v).first->second;
    }
    replace_vertices(soup, target);
    return largest;
}

void replace_vertices(TriangleSoup& soup, const std::vector<std::uint32_t>& target) {
    for (SoupTriangle& t : soup.triangles)
        for (std::uint32_t& v : t.vertices) v = target[v];
}

}  // namespace transillum
