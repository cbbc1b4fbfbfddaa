/// The whole pipeline: scene to solution.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/first_shot/light_samples.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/repair/repair_scene.h>
#include <transillum/scene/scene.h>
#include <transillum/solution/save_solution.h>
#include <transillum/solution/solution.h>
#include <transillum/transport/iterate.h>

#include <functional>
#include <string>

namespace transillum {

/// Refinement in phases (paper §3.2): every phase finds what the children of all leaves would
/// receive, in bins one level deeper, from twice as many directions as the one before (whose sums
/// it inherits), and splits the leaves and bins that are too coarse. After the last, as many
/// directions again follow at least.
struct RefinementOptions {
    int phases = 0;                ///< most; 0: patches stay as they are subdivided
    double tolerance = 0.1;        ///< see SplitOptions
    std::uint32_t max_leaves = 0;  ///< 0: four times as many as before
    bool direct = true;  ///< also by the first shot's light, for pictures that show it as stored
    /// Given every phase's solution on the children; may be empty.
    std::function<void(const Solution& phase, int number)> keep_phase;
};

/// Rooms that no light reaches.
enum class DarkRooms {
    automatic,  ///< left out of the transport, where they are much of the surface
    keep
};

struct BakeOptions {
    RepairOptions repair;  ///< its rounding is set to that of patches, Rounding::dyadic
    SurfaceOptions surface;
    SubdivisionOptions subdivision;
    LightSampleOptions light;
    BinOptions bins;
    RefinementOptions refinement;
    DarkRooms dark_rooms = DarkRooms::automatic;
    IterationOptions iteration;  ///< its pixel size and seed are set from the fields below
    int hemicube_resolution = 512;
    int resolution = 0;  ///< pixels across the transillumination buffer; 0: three a leaf's edge
    std::uint64_t memory = 0;  ///< most that tables may take [bytes]; 0: no limit
    std::uint64_t seed = 1;
};

/// Scene -> SurfaceMesh + PatchHierarchy -> DirectLight -> transport -> Solution.
/// \param run filled with thread count and wall time by phase, where given.
/// \pre the scene's albedos are limited (limit_albedo). When the monitor wants to stop, what is
/// done so far is a valid solution. Where the iteration keeps its sums, it can be gone on with
/// (resume.h), unless it was stopped before that. \throws InputError when the scene has no surface
/// or no light; UsageError, also where the tables would need more memory than is allowed.
[[nodiscard]] Solution bake(const Scene& scene, const BakeOptions& options, const Workers& workers,
                            Monitor& monitor, RunRecord* run = nullptr);

/// What bake keeps as RunRecord::input_hash.
[[nodiscard]] std::string hash_input(const Scene& scene, const BakeOptions& options);

}  // namespace transillum
