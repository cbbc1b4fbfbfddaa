/// Textures on the finite elements: a leaf takes the mean of what lies on it.
#pragma once

#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>

namespace transillum {

/// Texture coordinates of a point of a root, from barycentric coordinates of its second and third
/// vertex; (0, 0) where the mesh has none.
[[nodiscard]] glm::vec2 uv_at(const SurfaceMesh& mesh, std::uint32_t root, float b1, float b2);

/// Mean of a texture over a leaf: Texture::mean_over, whose precision it has.
[[nodiscard]] Spectrum texture_mean_over_leaf(const SurfaceMesh& mesh,
                                              const PatchHierarchy& patches, const Texture& texture,
                                              std::uint32_t leaf);

}  // namespace transillum
