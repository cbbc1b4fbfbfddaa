#include "repair/defects/edge_table.h"

#include <algorithm>
#include <tuple>

namespace transillum {

namespace {

/// Turns counts at [1 + i] into starts at [i].
void accumulate(std::vector<std::uint32_t>& counts) {
    for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
}

}  // namespace

EdgeTable::EdgeTable(const TriangleSoup& soup) {
    // Counted by their lower vertex first: what is left to sort are a few uses each.
    std::vector<std::uint32_t> starts(soup.positions.size() + 1, 0);
    const auto for_each_use = [&](const auto& visit) {
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            if (repeats_vertex(soup.triangles[t])) continue;
            const auto& v = soup.triangles[t].vertices;
            for (std::uint32_t c = 0; c < 3; ++c) {
                const std::uint32_t from = v[c], to = v[(c + 1) % 3];
                visit(EdgeUse{std::min(from, to), std::max(from, to), 3 * t + c, from < to});
            }
        }
    };
    for_each_use([&](const EdgeUse& use) { ++starts[use.low + 1]; });
    accumulate(starts);
    uses_.resize(starts.back());
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    for_each_use([&](const EdgeUse& use) { uses_[next[use.low]++] = use; });
    for (std::size_t i = 0; i + 1 < starts.size(); ++i)
        std::sort(uses_.begin() + starts[i], uses_.begin() + starts[i + 1],
                  [](const EdgeUse& a, const EdgeUse& b) {
                      return std::tie(a.high, a.side) < std::tie(b.high, b.side);
                  });
    for (std::uint32_t i = 0; i < uses_.size(); ++i)
        if (i == 0 || uses_[i].low != uses_[i - 1].low || uses_[i].high != uses_[i - 1].high)
            first_.push_back(i);
    first_.push_back(static_cast<std::uint32_t>(uses_.size()));
}

VertexCorners::VertexCorners(const TriangleSoup& soup) : first_(soup.positions.size() + 1, 0) {
    for (const SoupTriangle& t : soup.triangles)
        for (const std::uint32_t v : t.vertices) ++first_[v + 1];
    accumulate(first_);
    corners_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
        for (std::uint32_t c = 0; c < 3; ++c)
            corners_[next[soup.triangles[t].vertices[c]]++] = 3 * t + c;
}

std::vector<bool> border_vertices(const TriangleSoup& soup) {
    std::vector<bool> is_on_border(soup.positions.size(), false);
    const EdgeTable edges(soup);
    for (std::uint32_t e = 0; e < edges.size(); ++e)
        if (edges[e].size() == 1)
            is_on_border[edges[e].front().low] = is_on_border[edges[e].front().high] = true;
    return is_on_border;
}

}  // namespace transillum
