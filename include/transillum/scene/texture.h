/// Images on surfaces.
#pragma once

#include <transillum/base/spectrum.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace transillum {

/// Linear values, row-major from the image's top left; uv (0, 0) is the top left corner of the
/// first texel for glTF. Readers of formats whose v runs upwards turn it around.
struct Texture {
    enum class Wrap : std::uint8_t { repeat, mirrored, clamp };
    std::string name;  ///< for messages
    int width = 0, height = 0;
    std::vector<Spectrum> texels;  ///< width * height, finite
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;

    /// Bilinear between texel centres.
    [[nodiscard]] Spectrum at(glm::vec2 uv) const;
    /// Mean over a triangle in uv space, of the texels it covers.
    [[nodiscard]] Spectrum mean_over(const std::array<glm::vec2, 3>& triangle) const;
};

}  // namespace transillum
