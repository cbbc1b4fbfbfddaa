#include "solution/group_colours.h"

#include <transillum/solution/spectral_solution.h>

namespace transillum {

void put_into_group(Solution& solution, const SpectralSolution& spectral, const Bands& bands,
                    int group) {
    const BandGroup& own = spectral.groups[static_cast<std::size_t>(group)];
    Colours colours = colours_in_group(colours_of(spectral.rgb), bands, group);
    for (std::size_t i = 0; i < own.materials.size(); ++i) {
        colours.materials[i].diffuse = own.materials[i].diffuse;
        colours.materials[i].specular = own.materials[i].specular;
        colours.materials[i].emission = own.materials[i].emission;
    }
    put_colours(solution, std::move(colours));
    solution.direct_irradiance = own.direct_irradiance;
    solution.indirect_irradiance = own.indirect_irradiance;
    solution.standard_error = own.standard_error;
    solution.glossy_elements = own.glossy_elements;
}

Solution solution_of_group(const SpectralSolution& spectral, int group) {
    Solution solution = spectral.rgb;
    put_into_group(solution, spectral, Bands(spectral.bands), group);
    return solution;
}

}  // namespace transillum
