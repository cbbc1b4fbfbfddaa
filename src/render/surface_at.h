/// What a surface reflects and emits at a point of a root triangle, where textures say so.
#pragma once

#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/scene/brdf.h>
#include <transillum/visibility/ray_tracer.h>

#include <cstdint>

namespace transillum {

/// \param b1, b2 barycentric coordinates of the root's second and third vertex. Of the front;
/// whether the back does the same is Material's to say.
[[nodiscard]] Brdf brdf_at(const SurfaceMesh& mesh, std::uint32_t root, double b1, double b2);
[[nodiscard]] Spectrum emission_at(const SurfaceMesh& mesh, std::uint32_t root, double b1,
                                   double b2);

/// Barycentric coordinates within a leaf from those within its root; none below 0, though a hit may
/// lie a rounding error outside.
[[nodiscard]] glm::vec3 within_leaf(const PatchHierarchy& patches, std::uint32_t leaf,
                                    const Hit& hit);

/// Mean emission over a root.
[[nodiscard]] Spectrum mean_emission(const SurfaceMesh& mesh, std::uint32_t root);

}  // namespace transillum
