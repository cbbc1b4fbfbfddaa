/// Measured luminous intensity distributions (IES LM-63, type C).
#pragma once

#include <string>
#include <vector>

namespace transillum {

/// Luminous intensity [cd] over polar angles gamma, from the nadir, and azimuths C. The azimuths
/// tell the symmetry: 0 alone: none depends on C; 0 to 90: of all four quadrants; 0 to 180: of the
/// halves beside the plane C = 0; 90 to 270: beside the plane C = 90; 0 to 360: none.
struct Photometry {
    std::string name;                ///< file, for messages
    std::vector<double> vertical;    ///< gamma [degrees], ascending within [0, 180]
    std::vector<double> horizontal;  ///< C [degrees], ascending as above
    std::vector<double> candela;     ///< [horizontal * vertical.size() + vertical], not negative

    /// Bilinear in the angles [degrees], C any number; 0 beyond the first or last gamma.
    [[nodiscard]] double candela_at(double c, double gamma) const;
    /// Luminous flux [lm]: the exact integral of candela_at over the sphere.
    [[nodiscard]] double flux() const;
};

}  // namespace transillum
