#include "solution/group_colours.h"

#include "solution/leaf_colours.h"

#include <transillum/first_shot/light_samples.h>

#include <utility>

namespace transillum {

namespace {

std::vector<std::int8_t> bin_levels_of(const GlossySides& glossy) {
    std::vector<std::int8_t> levels;
    for (const std::uint32_t side : glossy.of_root_side)
        levels.push_back(side == GlossySides::none
                             ? std::int8_t{-1}
                             : static_cast<std::int8_t>(glossy.sides[side].bin_level));
    return levels;
}

}  // namespace

Colours colours_of(const Solution& solution) {
    return {solution.surface.materials, solution.surface.textures, solution.lighting};
}

void put_colours(Solution& solution, Colours colours) {
    solution.surface.materials = std::move(colours.materials);
    solution.surface.textures = std::move(colours.textures);
    solution.lighting = std::move(colours.lighting);
    solution.glossy =
        lay_out_glossy_sides(solution.surface, solution.patches, bin_levels_of(solution.glossy));
    average_textures(solution);
    relight_samples(solution.surface, solution.lighting.lights, solution.direct.samples);
}

}  // namespace transillum
