#include "repair/split_t_junctions.h"

#include "repair/part_uvs.h"

namespace transillum {

std::uint64_t split_t_junctions(TriangleSoup& soup, const std::vector<TJunction>& junctions) {
    std::uint64_t joined = 0;
    std::vector<SoupTriangle> triangles;
    std::vector<std::array<glm::vec2, 3>> uvs;
    auto junction = junctions.begin();
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const SoupTriangle& whole = soup.triangles[t];
        if (junction == junctions.end() || junction->triangle != t) {
            triangles.push_back(whole);
            if (!soup.uvs.empty()) uvs.push_back(soup.uvs[t]);
            continue;
        }
        const std::uint32_t edge = junction->edge;
        const std::uint32_t end = whole.vertices[(edge + 1) % 3];
        const std::uint32_t opposite = whole.vertices[(edge + 2) % 3];
        std::uint32_t last = whole.vertices[edge];
        const auto add = [&](std::uint32_t next) {
            SoupTriangle part = whole;
            part.vertices = {last, next, opposite};
            triangles.push_back(part);
            if (!soup.uvs.empty()) uvs.push_back(uvs_of_part(soup, t, part.vertices));
            last = next;
        };
        for (; junction != junctions.end() && junction->triangle == t; ++junction) {
            if (junction->edge != edge) continue;
            add(junction->vertex);
            ++joined;
        }
        add(end);
    }
    soup.triangles = std::move(triangles);
    soup.uvs = std::move(uvs);
    return joined;
}

}  // namespace transillum
