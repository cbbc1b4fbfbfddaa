/// Files of a radiance mesh, by the extension of their name:
///   .glb  glTF 2.0: a node and a mesh an object, COLOR_0 (display, linear), KHR_materials_unlit;
///         backs of triangles are not drawn. Positions are floats about a node in the scene's
///         middle
///         With a lightmap: TEXCOORD_1, and its picture as the material's, instead of COLOR_0;
///         TEXCOORD_0 are the scene's, or if it has none the lightmap's
///   .ply  binary: x y z, red green blue (display, as sRGB bytes), radiance_r radiance_g radiance_b
///   .vtp  one PolyData: point arrays Radiance and Display, cell arrays Object and Material, their
///         names as field arrays ObjectNames and MaterialNames
/// Only .glb holds a lightmap.
#pragma once

#include <transillum/solution/radiance_mesh.h>

#include <filesystem>

namespace transillum {

/// \throws UsageError for another extension
void require_mesh_extension(const std::filesystem::path& path);

/// Replaces what was there as a whole, or leaves it as it was.
/// \throws UsageError for another extension or with a lightmap and not .glb, InputError where the
/// mesh is empty or more than the format holds, IoError
void save_radiance_mesh(const RadianceMesh& mesh, const std::filesystem::path& path);

}  // namespace transillum
