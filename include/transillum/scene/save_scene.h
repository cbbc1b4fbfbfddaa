/// Writes OBJ + MTL, PLY, STL, OFF and glTF 2.0 (.gltf, .glb), by the file's extension.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <filesystem>

namespace transillum {

/// Are polygons of any number of corners kept (OBJ, PLY, OFF), or are triangles needed (STL, glTF)?
/// \throws UsageError on an extension that none of the formats has.
[[nodiscard]] bool holds_polygons(const std::filesystem::path& path);

/// Whether a format holds this, load_scene reads back:
///
///   OBJ     all but lights: positions, UVs and uniform materials to the bit; GGX lobes as the
///           max-Phong lobes nearest to them. Cameras are comments, as load_scene reads them.
///   PLY     positions and polygons, to the bit (binary, double precision)
///   OFF     positions and polygons, to the bit
///   STL     triangles (binary, single precision)
///   glTF    triangles (single precision), materials within rounding, max-Phong lobes as the GGX
///           lobes nearest to them; cameras; lights without photometry. Materials group an object's
///           triangles.
///
/// Polygons come in the order of their objects, else in the scene's. Images go beside the file
/// (.glb: into it) as PNG: 8 bits a channel where that gives back every texel, else 16, which are
/// within 2e-5 of the largest texel. A warning names each kind of thing that the format cannot
/// hold, a note how far rounding to single precision moved a vertex.
/// Either all files are written or none is changed.
/// \throws UsageError as holds_polygons; InputError where there is no polygon, one has more corners
/// or a coordinate is larger than the format holds; IoError
void save_scene(const Scene& scene, const std::filesystem::path& path, Monitor& monitor);

}  // namespace transillum
