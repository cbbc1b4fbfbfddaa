/// What the viewer can show of a solution, in the order of its keys.
#pragma once

#include <transillum/render/make_radiance_mesh.h>

#include <functional>
#include <string>
#include <vector>

namespace transillum::viewer {

struct Quantity {
    std::string name, unit;
    /// Shown as an exposed picture, interpolated; else by a colour map of `value`.
    bool is_picture = false;
    Components components;  ///< of a picture
    std::function<double(std::uint32_t patch)> value;
};

/// Keeps a reference.
[[nodiscard]] std::vector<Quantity> quantities_of(const Solution& solution);

/// Lines that say all that is known of a patch.
[[nodiscard]] std::string describe_patch(const Solution& solution, std::uint32_t patch);

}  // namespace transillum::viewer
