/// Reflectances of the same colour that are different spectra.
#pragma once

#include <transillum/scene/bands.h>

#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace transillum::testing_support {

inline SpectrumTable table_of(const char* name, double (*value)(double nm)) {
    SpectrumTable table{name, {}, {}};
    for (int nm = 400; nm <= 700; ++nm) {
        table.wavelengths.push_back(nm);
        table.values.push_back(value(nm));
    }
    return table;
}

/// A constant 0.5, and 0.5 with bumps at four wavelengths that together are colourless in these
/// bands; the highest or deepest is 0.4.
inline std::pair<SpectrumTable, SpectrumTable> grey_metamers(const Bands& bands) {
    const SpectrumTable flat = table_of("flat", [](double) { return 0.5; });
    constexpr std::array<double, 4> centres{450.0, 510.0, 570.0, 630.0};
    std::array<SpectrumTable, 4> bumps;
    std::array<SpectrumSum, 4> colours;
    for (std::size_t i = 0; i < 4; ++i) {
        bumps[i] = flat;
        for (std::size_t k = 0; k < flat.values.size(); ++k)
            bumps[i].values[k] = std::exp(-std::pow((flat.wavelengths[k] - centres[i]) / 20.0, 2));
        colours[i] = bands.rgb_of(bumps[i]);
    }
    const glm::dvec3 three =
        glm::inverse(glm::dmat3(colours[0], colours[1], colours[2])) * -colours[3];
    const std::array<double, 4> weights{three.x, three.y, three.z, 1.0};
    SpectrumTable bumpy = flat;
    bumpy.name = "bumpy";
    double most = 0.0;
    for (std::size_t k = 0; k < flat.values.size(); ++k) {
        bumpy.values[k] = 0.0;
        for (std::size_t i = 0; i < 4; ++i) bumpy.values[k] += weights[i] * bumps[i].values[k];
        most = std::max(most, std::abs(bumpy.values[k]));
    }
    for (double& value : bumpy.values) value = 0.5 + 0.4 * value / most;
    return {flat, bumpy};
}

}  // namespace transillum::testing_support
