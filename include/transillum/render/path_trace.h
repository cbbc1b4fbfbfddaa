/// Reference images: unbiased path tracing of emitters, lights and environment between Lambert and
/// glossy surfaces, textured or not, with light sampling and Russian roulette (Embree).
/// Shares nothing with the transport but the surfaces, so that it can be held against it.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/render/image.h>
#include <transillum/scene/lighting.h>

namespace transillum {

struct PathTraceOptions {
    int width = 500, height = 500;
    int samples = 256;    ///< paths a pixel
    int max_bounces = 0;  ///< reflections; 0: no limit, roulette alone ends paths
    std::uint64_t seed = 1;
    /// What paths find is shared between the pixels of a tile; else every pixel has its own.
    bool shares_paths = true;
};

/// Asked to stop, it returns the mean of the paths it has. The image does not depend on the number
/// of threads. \throws UsageError on a size, count or camera it cannot use.
[[nodiscard]] Image path_trace(const SurfaceMesh& surface, const Lighting& lighting,
                               const Camera& camera, const PathTraceOptions& options,
                               const Workers& workers, Monitor& monitor);

/// Irradiance [W m^-2] at a point of a surface, for tests against closed forms.
[[nodiscard]] Spectrum path_trace_irradiance(const SurfaceMesh& surface, const Lighting& lighting,
                                             const glm::dvec3& point, const glm::dvec3& normal,
                                             int paths, std::uint64_t seed);

}  // namespace transillum
