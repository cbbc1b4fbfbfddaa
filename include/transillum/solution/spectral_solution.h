/// A solution in bands of wavelengths (bands.h): what all of them share, and what is a group's own.
///
/// Geometry, patches, direction bins and what patches see of light samples are alike in all groups.
/// Colours that were not measured follow from RGB (colours.h); so do textures.
#pragma once

#include <transillum/scene/bands.h>
#include <transillum/scene/colours.h>
#include <transillum/solution/solution.h>

#include <vector>

namespace transillum {

/// As in Material.
struct MaterialColours {
    Spectrum diffuse{0.0f}, specular{0.0f}, emission{0.0f};
};

/// Three bands; the members named as those of Solution mean the same.
struct BandGroup {
    std::vector<MaterialColours> materials;  ///< one a material
    std::vector<Spectrum> direct_irradiance, indirect_irradiance, standard_error, glossy_elements;
};

struct SpectralSolution {
    /// A whole solution: its materials are the colours of the spectra, its light that of the
    /// groups, converted to linear sRGB; what lies outside sRGB is cut off.
    Solution rgb;
    int bands = 0;                  ///< 0: there is only RGB
    std::vector<BandGroup> groups;  ///< as Bands counts them
};

/// Makes of a copy of `spectral.rgb`, or of one that was put into another group, the solution of
/// this one: its channels are the group's three bands.
void put_into_group(Solution& solution, const SpectralSolution& spectral, const Bands& bands,
                    int group);

/// \throws UsageError where spectral.bands is out of range.
[[nodiscard]] Solution solution_of_group(const SpectralSolution& spectral, int group);

}  // namespace transillum
