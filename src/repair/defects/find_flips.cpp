#include "repair/defects/find_defects.h"
#include "repair/defects/find_sheets.h"
#include "repair/defects/measure_shell.h"

#include <glm/geometric.hpp>

#include <array>
#include <optional>

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

/// The way to turn where the larger one is, as in Ways; none where neither is clearly larger.
std::optional<int> clear_way(const Ways& ways) {
    if (ways.emitting[0] > 0.0 || ways.emitting[1] > 0.0) return ways.emitting[0] > 0.0 ? 1 : 0;
    const int larger = ways.area[1] > ways.area[0] ? 1 : 0;
    if (ways.area[larger] < 0.6 * (ways.area[0] + ways.area[1])) return {};
    return 1 - larger;
}

/// The one that looks inwards; of what is open, or encloses nothing, the smaller.
int inward_way(const Ways& ways, const Shell& shell) {
    const double volume = is_closed(shell) ? enclosed_volume(shell) : 0.0;
    if (volume != 0.0) return volume > 0.0 ? 1 : 0;
    return ways.area[1] > ways.area[0] ? 0 : 1;
}

/// Of every sheet, the way to turn; 2 where none is.
std::vector<int> ways_to_turn(const TriangleSoup& soup, const EdgeTable& edges,
                              const Sheets& sheets, const std::vector<Ways>& ways) {
    std::vector<int> turn(sheets.size(), 2);
    std::optional<Shells> shells;
    for (std::uint32_t s = 0; s < sheets.size(); ++s) {
        if (!sheets.mixed[s] || !sheets.orientable[s]) continue;
        const std::optional<int> way = clear_way(ways[s]);
        if (!way && !shells) shells.emplace(soup, edges, sheets);
        turn[s] = way ? *way : inward_way(ways[s], shells->make(s));
    }
    return turn;
}

}  // namespace

Flips find_flips(const TriangleSoup& soup, const Scene& scene) {
    const EdgeTable edges(soup);
    const Sheets sheets = find_sheets(soup, edges);
    const std::vector<Ways> ways = measure_ways(soup, scene, sheets);
    const std::vector<int> turn = ways_to_turn(soup, edges, sheets, ways);
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
        } else {
            flips.turn[t] = (sheets.turned[t] ? 1 : 0) == turn[s];
        }
    }
    return flips;
}

}  // namespace transillum
