/// Reads glTF 2.0 (.gltf, .glb), OBJ + MTL, PLY, STL and OFF.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <filesystem>

namespace transillum {

/// Which sides of a surface reflect and emit.
enum class Sides {
    file,  ///< as the file says: glTF `doubleSided`; OBJ, PLY, STL, OFF: both reflect, the front
           ///< emits
    one,   ///< the back of every surface is black
    two    ///< both sides reflect and emit alike
};

struct LoadOptions {
    Sides sides = Sides::file;
    bool drop_transparent =
        false;  ///< leave out surfaces whose opacity is below 1 instead of treating them as opaque
};

/// Loads a scene and proves that what was read is what the file holds: counts, indices, finite
/// coordinates, albedo in [0, 1] or reducible to it, emission not negative.
/// Anything changed or not honoured on the way goes to the monitor, naming the material or node.
/// \throws InputError naming file, line or object and face, what was found and what is accepted;
///         IoError when the file cannot be read.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, const LoadOptions& options,
                               Monitor& monitor);

}  // namespace transillum
