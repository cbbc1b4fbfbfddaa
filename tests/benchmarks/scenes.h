/// Scenes for measuring: a closed room with a grid of spheres in it.
#pragma once

#include <transillum/geometry/surface_mesh.h>
#include <transillum/scene/scene.h>

namespace transillum::benchmarks {

/// \param spheres along each edge of the grid; \param rings of a sphere's tessellation: 2 * rings *
/// (rings - 1) * 2 triangles each.
/// All of it emits and reflects.
[[nodiscard]] Scene scene_of_spheres(int spheres, int rings);
[[nodiscard]] SurfaceMesh room_of_spheres(int spheres, int rings);

}  // namespace transillum::benchmarks
