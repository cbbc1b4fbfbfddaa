#include "repair/find_defects.h"
#include "repair/find_sheets.h"

#include <glm/geometric.hpp>

#include <array>

namespace transillum {

namespace {

/// Areas of a sheet's two ways: 0 as its first triangle runs, 1 the other.
struct Ways {
    std::array<double, 2> area{}, emitting{};  ///< emitting: from the front alone
};

std::vector<Ways> measure_ways(const TriangleSoup& soup, const Scene& scene, const Sheets& sheets) {
    std::vector<Ways> ways(sheets.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const Material& m = scene.materials[scene.polygons[soup.triangles[t].polygon].material];
        const double area = glm::length(area_vector(soup, t));
        const int way = sheets.turned[t] ? 1 : 0;
        ways[sheets.sheet[t]].area[way] += area;
        if (m.emits() && !m.back_emits) ways[sheets.sheet[t]].emitting[way] += area;
    }
    return ways;
}

/// The way to turn, as in Ways.
int way_to_turn(const Ways& ways, bool closed, double volume) {
    if (ways.emitting[0] > 0.0 || ways.emitting[1] > 0.0) return ways.emitting[0] > 0.0 ? 1 : 0;
    const int larger = ways.area[1] > ways.area[0] ? 1 : 0;
    const bool is_clear = ways.area[larger] >= 0.6 * (ways.area[0] + ways.area[1]);
    if (closed && !is_clear && volume != 0.0) return volume > 0.0 ? 1 : 0;
    return 1 - larger;
}

}  // namespace

Flips find_flips(const TriangleSoup& soup, const Scene& scene) {
    const EdgeTable edges(soup);
    const Sheets sheets = find_sheets(soup, edges);
    const std::vector<Ways> ways = measure_ways(soup, scene, sheets);
    Flips flips;
    flips.turn.assign(soup.triangles.size(), false);
    flips.non_orientable = flips.emits_both_ways = flips.turn;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const std::uint32_t s = sheets.sheet[t];
        const Ways& w = ways[s];
        if (!sheets.orientable[s]) {
            flips.non_orientable[t] = true;
        } else if (w.emitting[0] > 0.0 && w.emitting[1] > 0.0) {
            flips.emits_both_ways[t] = true;
        } else if (sheets.mixed[s]) {
            const int way = way_to_turn(w, sheets.closed[s], sheets.volume[s]);
            flips.turn[t] = (sheets.turned[t] ? 1 : 0) == way;
        }
    }
    return flips;
}

}  // namespace transillum
