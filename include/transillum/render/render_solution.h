/// Measurement of a solution by a camera (paper §2.2, operator M): eye rays to the first surface,
/// and there emission + direct + finite-element radiance.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/render/image.h>
#include <transillum/solution/solution.h>

namespace transillum {

enum class DirectShading {
    stored,  ///< the patch's stored incoming radiance, interpolated like the finite elements
    traced   ///< shadow rays to the light samples, at every point
};

struct Components {
    bool emission = true, direct = true, finite_element = true;
};

struct RenderOptions {
    int width = 500, height = 500;
    int samples = 16;  ///< most rays a pixel [1, 4096]; flat pixels get fewer
    DirectShading direct = DirectShading::traced;
    bool interpolate = true;  ///< Gouraud within shading fans; else one radiance a patch
    Components components;
    std::uint64_t seed = 1;
};

/// Pixels are means over their squares. The image does not depend on the number of threads.
[[nodiscard]] Image render_solution(const Solution& solution, const Camera& camera,
                                    const RenderOptions& options, const Workers& workers,
                                    Monitor& monitor);

/// The camera of that name, or its first where the name is empty, or, where it has none, a
/// view that frames the whole surface. \throws UsageError listing the names there are.
[[nodiscard]] Camera choose_camera(const std::vector<Camera>& cameras, const SurfaceMesh& surface,
                                   const std::string& name);

}  // namespace transillum
