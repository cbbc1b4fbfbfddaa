#include <transillum/scene/bands.h>

#include "scene/cie1931.h"
#include "scene/colour_basis.h"

#include <transillum/base/error.h>

#include <glm/matrix.hpp>

#include <algorithm>
#include <string>

namespace transillum {

namespace {

glm::dvec3 xyz_of(double x, double y) {
    return {x / y, 1.0, (1.0 - x - y) / y};
}

/// IEC 61966-2-1: primaries and white as CIE 1931 chromaticities.
glm::dvec3 srgb_white() {
    return xyz_of(0.3127, 0.3290);
}

glm::dmat3 xyz_from_srgb() {
    const glm::dmat3 primaries(xyz_of(0.64, 0.33), xyz_of(0.30, 0.60), xyz_of(0.15, 0.06));
    const glm::dvec3 share = glm::inverse(primaries) * srgb_white();
    return {share.x * primaries[0], share.y * primaries[1], share.z * primaries[2]};
}

/// Bradford's: von Kries' in sharpened cone responses (Lam 1985).
glm::dmat3 adaptation(const glm::dvec3& from_white, const glm::dvec3& to_white) {
    const glm::dmat3 cones = glm::transpose(
        glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const glm::dvec3 ratio = (cones * to_white) / (cones * from_white);
    return glm::inverse(cones) *
           glm::dmat3(ratio.x, 0.0, 0.0, 0.0, ratio.y, 0.0, 0.0, 0.0, ratio.z) * cones;
}

/// What a value of 1 in each band alone looks like; all bands together are white.
std::vector<glm::dvec3> colours_of_bands(const Bands& bands) {
    const auto curve = [](const char* column) {
        return parse_spectrum("cie1931.csv", cie_1931_csv, column);
    };
    const SpectrumTable x = curve("xbar"), y = curve("ybar"), z = curve("zbar");
    std::vector<glm::dvec3> xyz;
    glm::dvec3 white(0.0);
    for (int b = 0; b < bands.count(); ++b) {
        const double from = bands.edge(b), to = bands.edge(b + 1);
        xyz.emplace_back(x.integral(from, to), y.integral(from, to), z.integral(from, to));
        white += xyz.back();
    }
    const glm::dmat3 rgb_from_xyz =
        glm::inverse(xyz_from_srgb()) * adaptation(white / white.y, srgb_white());
    std::vector<glm::dvec3> rgb;
    for (const glm::dvec3& colour : xyz) rgb.push_back(rgb_from_xyz * colour / white.y);
    return rgb;
}

int checked(int count) {
    if (count < least_bands || count > most_bands)
        throw UsageError(std::to_string(count) + " bands; accepted: " +
                         std::to_string(least_bands) + " to " + std::to_string(most_bands));
    return count;
}

}  // namespace

Bands::Bands(int count) : count_(checked(count)) {
    const std::vector<glm::dvec3> rgb = colours_of_bands(*this);
    const std::vector<glm::dvec3> shares = find_colour_basis(rgb);
    for (int first = 0; first < count; first += channel_count) {
        glm::dmat3 to(0.0), from(0.0);
        for (int c = 0; c < channel_count; ++c) {
            const auto band = static_cast<std::size_t>(std::min(first + c, count - 1));
            if (first + c < count) to[c] = rgb[band];
            from[c] = shares[band];
        }
        rgb_from_group_.push_back(to);
        group_from_rgb_.push_back(glm::transpose(from));
    }
}

double Bands::edge(int band) const {
    return shortest_wavelength + (longest_wavelength - shortest_wavelength) * band / count_;
}

int Bands::band_of(int group, int channel) const {
    return std::min(channel_count * group + channel, count_ - 1);
}

Spectrum Bands::in_group(const SpectrumTable& table, int group) const {
    Spectrum values;
    for (int c = 0; c < channel_count; ++c) {
        const int band = band_of(group, c);
        values[c] = static_cast<float>(table.mean_over(edge(band), edge(band + 1)));
    }
    return values;
}

SpectrumSum Bands::rgb_of(const SpectrumTable& table) const {
    SpectrumSum rgb(0.0);
    for (int g = 0; g < groups(); ++g) rgb += rgb_from_group(g) * SpectrumSum(in_group(table, g));
    return rgb;
}

}  // namespace transillum
