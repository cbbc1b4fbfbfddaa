/// What one channel of a material reflects, and how it is limited.
#pragma once

#include "scene/ggx.h"

#include <transillum/scene/scene.h>

#include <array>

namespace transillum {

/// Of a material's kind; the reflectances are arguments, as textures vary them.
class ChannelLimit {
public:
    explicit ChannelLimit(const Material& material);

    /// Bound of the reflected share [1]; grows with both arguments.
    [[nodiscard]] float reflected(float diffuse, float specular) const;
    /// Scales both down until they reflect no more than `most`.
    void limit(float& diffuse, float& specular, float most) const;

private:
    bool couples_;
    std::array<GgxShares, 2> shares_{};  ///< along the normal; of uniform light
};

}  // namespace transillum
