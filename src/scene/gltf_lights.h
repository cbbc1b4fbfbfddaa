/// Lights of a glTF scene: KHR_lights_punctual.
#pragma once

#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"

#include <transillum/base/monitor.h>
#include <transillum/scene/punctual_light.h>

#include <vector>

namespace transillum {

/// Appends the light of a node, where it has one. Candela and lux are taken as W sr^-1 and W m^-2;
/// a range is not honoured, which is noted. \throws InputError naming file and place.
void read_gltf_light(const GltfDocument& document, const GltfNode& node,
                     std::vector<PunctualLight>& lights, Monitor& monitor);

}  // namespace transillum
