#include <transillum/scene/photometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace transillum {

namespace {

constexpr double radians = std::numbers::pi / 180.0;

/// Into the range of azimuths that was measured.
double folded(double c, const std::vector<double>& horizontal) {
    c -= 360.0 * std::floor(c / 360.0);
    const double first = horizontal.front(), last = horizontal.back();
    if (first == 90.0) return c < 90.0 ? 180.0 - c : c > 270.0 ? 540.0 - c : c;
    if (last == 90.0) c = c > 180.0 ? c - 180.0 : c;
    if (last == 90.0) return c > 90.0 ? 180.0 - c : c;
    return last == 180.0 && c > 180.0 ? 360.0 - c : c;
}

struct Between {
    std::size_t below, above;
    double share;  ///< of the value above
};

/// \pre value within the angles.
Between find(const std::vector<double>& angles, double value) {
    const auto above = std::upper_bound(angles.begin(), angles.end(), value);
    if (above == angles.begin()) return {0, 0, 0.0};
    const auto i = static_cast<std::size_t>(above - angles.begin());
    if (above == angles.end()) return {i - 1, i - 1, 0.0};
    return {i - 1, i, (value - angles[i - 1]) / (angles[i] - angles[i - 1])};
}

}  // namespace

double Photometry::candela_at(double c, double gamma) const {
    if (!(gamma >= vertical.front() && gamma <= vertical.back())) return 0.0;
    const Between v = find(vertical, gamma);
    const Between h =
        horizontal.size() == 1 ? Between{0, 0, 0.0} : find(horizontal, folded(c, horizontal));
    const auto along = [&](std::size_t row) {
        const double* values = candela.data() + row * vertical.size();
        return values[v.below] + v.share * (values[v.above] - values[v.below]);
    };
    const double first = along(h.below);
    return first + h.share * (along(h.above) - first);
}

double Photometry::flux() const {
    // Of a half plane: linear between the angles, times the sine.
    const auto per_azimuth = [&](std::size_t row) {
        const double* values = candela.data() + row * vertical.size();
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < vertical.size(); ++i) {
            const double a = radians * vertical[i], b = radians * vertical[i + 1];
            const double slope = (values[i + 1] - values[i]) / (b - a);
            sum += values[i] * std::cos(a) - values[i + 1] * std::cos(b) +
                   slope * (std::sin(b) - std::sin(a));
        }
        return sum;
    };
    if (horizontal.size() == 1) return 2.0 * std::numbers::pi * per_azimuth(0);
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < horizontal.size(); ++i)
        sum += 0.5 * radians * (horizontal[i + 1] - horizontal[i]) *
               (per_azimuth(i) + per_azimuth(i + 1));
    return sum * 360.0 / (horizontal.back() - horizontal.front());
}

}  // namespace transillum
