#include "repair/find_components.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace transillum {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

/// The edges that end sheets, followed around their vertices from face to face.
class BorderLoops {
public:
    BorderLoops(const TriangleSoup& soup, const EdgeTable& edges)
        : soup_(soup), across_(3 * soup.triangles.size(), none), parent_(across_.size()) {
        std::iota(parent_.begin(), parent_.end(), 0u);
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            if (edges[e].size() != 2) continue;
            across_[edges[e][0].side] = edges[e][1].side;
            across_[edges[e][1].side] = edges[e][0].side;
        }
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            if (edges[e].size() == 2) continue;
            for (const EdgeUse& use : edges[e])
                for (const std::uint32_t vertex : {use.low, use.high})
                    join(use.side, next_border(use.side, vertex));
        }
    }

    /// The loop of a side that ends its sheet, as the smallest of its sides.
    std::uint32_t loop_of(std::uint32_t side) {
        while (parent_[side] != side) side = parent_[side] = parent_[parent_[side]];
        return side;
    }

private:
    [[nodiscard]] std::uint32_t next_border(std::uint32_t side, std::uint32_t vertex) const {
        do {
            const std::uint32_t triangle = side / 3, corner = side % 3;
            const bool starts_here = soup_.triangles[triangle].vertices[corner] == vertex;
            side = 3 * triangle + (corner + (starts_here ? 2 : 1)) % 3;
            if (across_[side] == none) return side;
            side = across_[side];
        } while (true);
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = loop_of(a);
        b = loop_of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

    const TriangleSoup& soup_;
    std::vector<std::uint32_t> across_, parent_;
};

}  // namespace

std::vector<Component> find_components(const TriangleSoup& soup, const Scene& scene,
                                       const EdgeTable& edges, const Sheets& sheets) {
    std::vector<Component> components(sheets.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        Component& c = components[sheets.sheet[t]];
        if (c.faces++ == 0) c.object = scene.polygons[soup.triangles[t].polygon].object;
    }
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        components[s].closed = sheets.closed[s];
        components[s].orientable = sheets.orientable[s];
        components[s].volume = sheets.mixed[s] ? std::abs(sheets.volume[s]) : sheets.volume[s];
    }
    BorderLoops loops(soup, edges);
    std::vector<std::uint32_t> found;
    for (std::uint32_t e = 0; e < edges.size(); ++e)
        if (edges[e].size() == 1) found.push_back(loops.loop_of(edges[e].front().side));
    std::ranges::sort(found);
    const auto rest = std::ranges::unique(found);
    found.erase(rest.begin(), rest.end());
    for (const std::uint32_t side : found) ++components[sheets.sheet[side / 3]].borders;
    return components;
}

}  // namespace transillum
