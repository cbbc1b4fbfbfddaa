/// glTF 2.0: .gltf with its buffers, and .glb.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <filesystem>

namespace transillum {

/// Meshes as their nodes place them, an object a node; materials; perspective cameras. What is not
/// honoured (other extensions, lights, skins, animations, vertex colours) goes to the monitor.
/// \throws InputError naming file and place; IoError.
[[nodiscard]] Scene read_gltf(const std::filesystem::path& path, Monitor& monitor);

}  // namespace transillum
