/// The whole pipeline: scene to solution.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/first_shot/light_samples.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/scene/scene.h>
#include <transillum/solution/save_solution.h>
#include <transillum/solution/solution.h>
#include <transillum/transport/iterate.h>

namespace transillum {

struct BakeOptions {
    SurfaceOptions surface;
    SubdivisionOptions subdivision;
    LightSampleOptions light;
    BinOptions bins;
    IterationOptions iteration;  ///< its pixel size and seed are set from the fields below
    int hemicube_resolution = 512;
    int resolution = 0;  ///< pixels across the transillumination buffer; 0: three a leaf's edge
    std::uint64_t seed = 1;
};

/// Scene -> SurfaceMesh + PatchHierarchy -> DirectLight -> transport -> Solution.
/// \param run filled with thread count and wall time by phase, where given.
/// \pre the scene's albedos are limited (limit_albedo). When the monitor wants to stop, what is
/// done so far is a valid solution. \throws InputError when the scene has no surface or no light;
/// UsageError.
[[nodiscard]] Solution bake(const Scene& scene, const BakeOptions& options, const Workers& workers,
                            Monitor& monitor, RunRecord* run = nullptr);

}  // namespace transillum
