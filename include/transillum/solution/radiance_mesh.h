/// A solution as other programs take it: triangles with a colour at each vertex, or with a
/// lightmap.
#pragma once

#include <transillum/base/spectrum.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace transillum {

struct RadianceMesh {
    struct Triangle {
        std::array<std::uint32_t, 3> vertices{};  ///< counter-clockwise seen from its lit side
        std::uint32_t object = 0, material = 0;
        std::uint32_t patch = 0;  ///< of the solution
    };

    std::vector<glm::dvec3> positions;
    std::vector<Spectrum> radiance;               ///< one a position [W sr^-1 m^-2]
    std::vector<Spectrum> display;                ///< the same, exposed: linear sRGB in [0, 1]
    std::vector<Triangle> triangles;              ///< object by object
    std::vector<std::string> objects, materials;  ///< names
    // With a lightmap alone, else empty. (0, 0) is a picture's upper left corner.
    std::vector<glm::vec2> lightmap_uvs;  ///< one a position, in [0, 1]
    std::vector<glm::vec2> uvs;           ///< of the scene's textures; empty if it has none, too
    std::string lightmap_png;             ///< a file that shows the lightmap, exposed

    double exposure = 0.0;  ///< [stops] that radiance was scaled by for `display`, before
                            ///< highlights were compressed
};

}  // namespace transillum
