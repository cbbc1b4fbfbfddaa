/// Solutions to be filled in by hand, and the materials on them.
#pragma once

#include <transillum/scene/brdf.h>
#include <transillum/solution/solution.h>

#include <vector>

namespace transillum::testing_support {

/// Everything black, and room for all that a solution holds.
inline Solution dark_solution(const SurfaceMesh& surface, int level) {
    Solution s;
    s.surface = surface;
    s.patches = subdivide_to_levels(std::vector<int>(surface.triangles.size(), level));
    s.glossy = lay_out_glossy_sides(surface, s.patches, choose_bin_levels(surface, {}));
    s.glossy_elements.assign(s.glossy.element_count, Spectrum(0.0f));
    s.direct_irradiance.assign(s.patches.patch_count(), Spectrum(0.0f));
    s.indirect_irradiance = s.standard_error = s.direct_irradiance;
    s.coverage.assign(s.patches.patch_count(), 1.0f);
    s.direct.shot_sides.assign(2 * surface.triangles.size(), 0);
    return s;
}

/// Every patch faces every light sample and sees it in part.
inline void leave_samples_in_doubt(Solution& s) {
    s.direct.geometry_factor.assign(s.direct.samples.size() * s.patches.patch_count(), 1.0f);
    s.direct.visibility.assign(s.direct.geometry_factor.size(), 0.5f);
}

inline Material glossy(Lobe lobe, float diffuse, float specular, float shininess, float roughness) {
    Material m;
    m.lobe = lobe;
    m.diffuse = Spectrum(diffuse);
    m.specular = Spectrum(specular);
    m.shininess = shininess;
    m.roughness = roughness;
    return m;
}

}  // namespace transillum::testing_support
