/// Light that comes from no surface.
#pragma once

#include <transillum/scene/environment.h>
#include <transillum/scene/punctual_light.h>

#include <vector>

namespace transillum {

struct Lighting {
    std::vector<PunctualLight> lights;
    Environment environment;
};

}  // namespace transillum
