/// What every reader needs to build a polygon soup.
#pragma once

#include <transillum/base/error.h>
#include <transillum/scene/scene.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace transillum {

/// Makes the corners added since `first_corner` a polygon.
inline void close_polygon(Scene& scene, std::size_t first_corner, std::uint32_t material,
                          std::uint32_t object) {
    if (scene.corners.size() > std::numeric_limits<std::uint32_t>::max())
        throw InputError(scene.path, "more than 4294967295 polygon corners; accepted: fewer");
    scene.polygons.push_back(
        {.first_corner = static_cast<std::uint32_t>(first_corner),
         .corner_count = static_cast<std::uint32_t>(scene.corners.size() - first_corner),
         .material = material,
         .object = object,
         .source_face = static_cast<std::uint32_t>(scene.polygons.size())});
}

/// "1 to n, or none" in messages about indices counted from 0.
inline std::string index_range(std::size_t count) {
    return count == 0 ? "none" : "0 to " + std::to_string(count - 1);
}

inline Material named_material(std::string_view name) {
    Material material;
    material.name = name;
    return material;
}

/// A value for a message: as short as it can be written exactly enough to recognise.
inline std::string shown(double value) {
    std::string text = std::to_string(value);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

}  // namespace transillum
