#include <transillum/base/error.h>
#include <transillum/repair/snap_grid.h>
#include <transillum/scene/used_positions.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace transillum {

namespace {

constexpr int grid_bits = 40;

/// GCC 12 leaves out pairs of conversions that it vectorizes, hence volatile.
double to_float(double x) {
    const volatile float rounded = static_cast<float>(x);
    return static_cast<double>(rounded);
}

glm::dvec3 to_floats(const glm::dvec3& p) {
    return {to_float(p.x), to_float(p.y), to_float(p.z)};
}

double largest_coordinate(const Scene& scene, const std::vector<bool>& used) {
    double largest = 0.0;
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const glm::dvec3 p = glm::abs(scene.positions[i]);
        if (used[i]) largest = std::max({largest, p.x, p.y, p.z});
    }
    return largest;
}

}  // namespace

void require_extent(const Scene& scene) {
    const double largest = largest_coordinate(scene, used_positions(scene));
    if (largest == 0.0 || (largest >= least_extent && largest <= most_extent)) return;
    std::ostringstream text;
    text << "the largest coordinate is " << largest << "; accepted: " << least_extent << " to "
         << most_extent << ", so in another unit";
    throw InputError(scene.path, text.str());
}

SnapGrid dyadic_grid(const Scene& scene) {
    const double largest = largest_coordinate(scene, used_positions(scene));
    if (largest == 0.0) return {-grid_bits, 0.0};
    int exponent = 0;
    std::frexp(largest, &exponent);  // largest < 2^exponent
    return {exponent - grid_bits, 0.0};
}

glm::dvec3 snap(const glm::dvec3& p, const SnapGrid& grid) {
    const auto round = [&](double x) {
        return std::ldexp(std::nearbyint(std::ldexp(x, -grid.exponent)), grid.exponent) + 0.0;
    };
    return {round(p.x), round(p.y), round(p.z)};
}

glm::dvec3 VertexRounding::operator()(const glm::dvec3& p) const {
    switch (rounding) {
        case Rounding::floats:
            return to_floats(p);
        case Rounding::dyadic:
            return snap(p, grid);
        case Rounding::doubles:
            break;
    }
    return p;
}

SnapGrid snap_scene(Scene& scene, Rounding rounding) {
    SnapGrid grid = dyadic_grid(scene);
    if (rounding == Rounding::doubles) return grid;
    const std::vector<bool> used = used_positions(scene);
    require_extent(scene);
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        if (!used[i]) continue;
        glm::dvec3& p = scene.positions[i];
        const glm::dvec3 rounded = VertexRounding{rounding, grid}(p);
        grid.largest_move = std::max(grid.largest_move, glm::length(rounded - p));
        p = rounded;
    }
    return grid;
}

}  // namespace transillum
