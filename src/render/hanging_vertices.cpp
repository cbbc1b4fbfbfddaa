#include "render/hanging_vertices.h"

#include <transillum/base/sampling.h>

#include <algorithm>

namespace transillum {

std::size_t HangingVertices::Hash::operator()(const Line& line) const {
    return hash_bits((static_cast<std::uint64_t>(line.first) << 32) | line.second);
}

HangingVertices::HangingVertices(const VertexGrid& grid) {
    for (const VertexGrid::Hanging& h : grid.hanging) {
        const Line line = std::minmax(h.from, h.to);
        const float share = line.first == h.from ? h.share : 1.0f - h.share;
        places_[h.vertex] = {line, share};
        lines_[line].emplace_back(share, h.vertex);
    }
    for (auto& [line, vertices] : lines_) std::ranges::sort(vertices);
}

float HangingVertices::share_on(const Line& line, std::uint32_t vertex) const {
    if (vertex == line.first) return 0.0f;
    if (vertex == line.second) return 1.0f;
    const auto place = places_.find(vertex);
    return place != places_.end() && place->second.line == line ? place->second.share : -1.0f;
}

/// The edge is one of the longest, or lies within one.
std::vector<std::uint32_t> HangingVertices::between(std::uint32_t from, std::uint32_t to) const {
    std::vector<std::uint32_t> result;
    if (places_.empty()) return result;
    std::vector<Line> candidates{std::minmax(from, to)};
    for (const std::uint32_t end : {from, to})
        if (const auto place = places_.find(end); place != places_.end())
            candidates.push_back(place->second.line);
    for (const Line& line : candidates) {
        const auto vertices = lines_.find(line);
        const float a = share_on(line, from), b = share_on(line, to);
        if (vertices == lines_.end() || a < 0.0f || b < 0.0f) continue;
        for (const auto& [share, vertex] : vertices->second)
            if (share > std::min(a, b) && share < std::max(a, b)) result.push_back(vertex);
        if (a > b) std::ranges::reverse(result);
        return result;
    }
    return result;
}

}  // namespace transillum
