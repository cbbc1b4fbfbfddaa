/// The node tree of a glTF scene, flattened.
#pragma once

#include "scene/gltf_document.h"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <vector>

namespace transillum {

struct GltfNode {
    std::size_t index = 0;  ///< into `nodes`
    glm::dmat4 world_from_node{1.0};
};

/// The nodes of the default scene (else the first; else all), parents before children.
/// \throws InputError naming a node that has two parents or itself as an ancestor, or a matrix that
/// is not finite.
[[nodiscard]] std::vector<GltfNode> flatten_nodes(const GltfDocument& document);

}  // namespace transillum
