#include <transillum/scene/environment.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

constexpr double pi = std::numbers::pi;

/// Turns with +y to `up` the shortest way; half a turn about x where that is -y.
glm::dvec3 turned_to(const glm::dvec3& up, const glm::dvec3& v) {
    const double cosine = up.y;
    if (cosine < -1.0 + 1e-12) return {v.x, -v.y, -v.z};
    const glm::dvec3 axis(up.z, 0.0, -up.x);  // y cross up
    const glm::dvec3 across = glm::cross(axis, v);
    return v + across + glm::cross(axis, across) / (1.0 + cosine);
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Spectrum look_up(const Environment& environment, const glm::dvec3& from) {
    const Texture& image = *environment.image;
    const glm::dvec3 north = turned_to(environment.up, {0, 0, -1});
    const glm::dvec3 east = turned_to(environment.up, {1, 0, 0});
    const double azimuth =
        std::atan2(glm::dot(from, east), glm::dot(from, north)) - environment.rotation;
    const double turns = azimuth / (2.0 * pi);
    const double x = (turns - std::floor(turns)) * image.width - 0.5;
    const double y = std::clamp(angle_between(from, environment.up) / pi * image.height - 0.5, 0.0,
                                image.height - 1.0);
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(y);
    const auto texel = [&](int column, int row) {
        column = (column + image.width) % image.width;
        row = std::min(row, image.height - 1);
        return SpectrumSum(image.texels[static_cast<std::size_t>(row) * image.width + column]);
    };
    const auto between = [&](int row) {
        const SpectrumSum left = texel(x0, row);
        return left + (x - x0) * (texel(x0 + 1, row) - left);
    };
    const SpectrumSum above = between(y0);
    return Spectrum(above + (y - y0) * (between(y0 + 1) - above));
}

/// Kittler's scattering indicatrix.
double clear_scattering(double chi) {
    const double c = std::cos(chi);
    return 0.91 + 10.0 * std::exp(-3.0 * chi) + 0.45 * c * c;
}

/// Gradation from the horizon (1) to the zenith.
double clear_gradation(double sine) {
    return 1.0 - std::exp(-0.32 / sine);
}

double clear_sky(const Environment& environment, const glm::dvec3& from, double sine) {
    const double scattering = clear_scattering(angle_between(from, environment.sun)) /
                              clear_scattering(angle_between(environment.up, environment.sun));
    return scattering * clear_gradation(sine) / clear_gradation(1.0);
}

}  // namespace

Spectrum Environment::radiance(const glm::dvec3& from) const {
    if (kind == Kind::none) return Spectrum(0.0f);
    if (kind == Kind::uniform) return radiance_scale;
    if (kind == Kind::image) return image ? radiance_scale * look_up(*this, from) : Spectrum(0.0f);
    const double sine = glm::dot(from, up);
    if (!(sine > 0.0)) return Spectrum(0.0f);
    const double relative =
        kind == Kind::overcast ? (1.0 + 2.0 * sine) / 3.0 : clear_sky(*this, from, sine);
    return radiance_scale * static_cast<float>(relative);
}

glm::dvec3 sky_direction(const glm::dvec3& up, double azimuth, double elevation) {
    const double level = std::cos(elevation);
    return turned_to(up,
                     {level * std::sin(azimuth), std::sin(elevation), -level * std::cos(azimuth)});
}

double texel_solid_angle(const Texture& lat_long, int row) {
    const double step = pi / lat_long.height, centre = (row + 0.5) * step;
    // Integrals of the sine of the polar angle times the rising and the falling half of the hat;
    // beyond the first and the last row it is 1.
    const auto slope = [&](double from) { return (std::sin(from + step) - std::sin(from)) / step; };
    const double above =
        row == 0 ? 1.0 - std::cos(centre) : slope(centre - step) - std::cos(centre);
    const double below =
        row == lat_long.height - 1 ? 1.0 + std::cos(centre) : std::cos(centre) - slope(centre);
    return 2.0 * pi / lat_long.width * (above + below);
}

}  // namespace transillum
