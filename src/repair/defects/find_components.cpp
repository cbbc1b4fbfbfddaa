#include "repair/defects/find_components.h"

#include "repair/defects/measure_shell.h"

#include <algorithm>
#include <cmath>

namespace transillum {

namespace {

/// Loops that are all edges of three or more faces are no border.
std::uint64_t count_borders(const Shells& shells, const Shell& shell) {
    const auto loops = border_loops(shell);
    return static_cast<std::uint64_t>(std::ranges::count_if(loops, [&](const auto& loop) {
        return std::ranges::any_of(loop, [&](std::uint32_t e) { return shells.is_border(e); });
    }));
}

}  // namespace

std::vector<Component> find_components(const TriangleSoup& soup, const Scene& scene,
                                       const EdgeTable& edges, const Sheets& sheets) {
    std::vector<Component> components(sheets.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        Component& c = components[sheets.sheet[t]];
        if (c.faces++ == 0) c.object = scene.polygons[soup.triangles[t].polygon].object;
    }
    const Shells shells(soup, edges, sheets);
    for (std::uint32_t s = 0; s < sheets.size(); ++s) {
        Component& c = components[s];
        const Shell shell = shells.make(s);
        c.closed = is_closed(shell);
        c.orientable = sheets.orientable[s];
        if (c.closed && c.orientable) {
            const double volume = enclosed_volume(shell);
            c.volume = sheets.mixed[s] ? std::abs(volume) : volume;
        }
        if (!c.closed) c.borders = count_borders(shells, shell) / (c.orientable ? 1 : 2);
    }
    return components;
}

}  // namespace transillum
