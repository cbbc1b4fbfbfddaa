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
    struct Level {
        int width = 0, height = 0;
        std::vector<Spectrum> texels{};
    };
    std::string name{};  ///< for messages
    int width = 0, height = 0;
    std::vector<Spectrum> texels{};  ///< width * height, finite
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    /// The image at half its size, a quarter, and so on to one texel, each with the image's mean;
    /// for mean_over alone. Empty, or as build_levels makes them.
    std::vector<Level> levels{};

    /// Bilinear between texel centres. \pre uv is finite
    [[nodiscard]] Spectrum at(glm::vec2 uv) const;
    /// Mean of `at` over a triangle in uv space; means over triangles that tile the image average
    /// to its own. Exact where it covers up to about 4000 texels. Larger ones are integrated on the
    /// first level where that holds, as if the image were blurred over some hundredths of the
    /// triangle: that bounds the cost, and is felt only along the outline. Without levels it is
    /// exact at any size, at the cost of a visit to every texel. A triangle without area is taken
    /// for its longest edge. \pre uv is finite
    [[nodiscard]] Spectrum mean_over(const std::array<glm::vec2, 3>& triangle) const;
    /// Mean of all texels.
    [[nodiscard]] Spectrum mean() const;
    void build_levels();
};

}  // namespace transillum
