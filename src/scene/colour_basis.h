/// Smooth spectra for the primaries of RGB, so that any colour becomes a spectrum linearly.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

namespace transillum {

/// Shares of red, green and blue in every band: not negative, together 1, so that reflectances stay
/// in [0, 1] and greys are constant. Their spectra give the primaries back,
/// sum over bands of rgb_of_band[b] * shares[b][k] = unit vector k, and of all that do, differ
/// least from band to band (in the mean square; after Mallett and Yuksel 2019, "Spectral Primary
/// Decomposition for Rendering with sRGB Reflectance").
/// \pre the values of rgb_of_band, one a band, add up to white. \throws Error where no spectra do.
[[nodiscard]] std::vector<glm::dvec3> find_colour_basis(const std::vector<glm::dvec3>& rgb_of_band);

}  // namespace transillum
