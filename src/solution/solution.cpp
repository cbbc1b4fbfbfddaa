#include <transillum/solution/solution.h>

#include <numbers>

namespace transillum {

namespace {

/// Lambert: every direction sees albedo * E / pi.
Spectrum reflected_radiance(const Solution& solution, std::uint32_t patch,
                            const Spectrum& irradiance) {
    if (!solution.reflects(patch)) return Spectrum(0.0f);
    return solution.material_of(patch).albedo() * irradiance * std::numbers::inv_pi_v<float>;
}

}  // namespace

Spectrum Solution::direct_radiance(std::uint32_t patch) const {
    return reflected_radiance(*this, patch, direct_irradiance[patch]);
}

Spectrum Solution::finite_element_radiance(std::uint32_t patch) const {
    return reflected_radiance(*this, patch, indirect_irradiance[patch]);
}

}  // namespace transillum
