/// Makes a scene's meshes sound: exactly where they meet, and saying what was done.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/repair/defects.h>
#include <transillum/repair/snap_grid.h>
#include <transillum/scene/scene.h>

#include <string>
#include <vector>

namespace transillum {

enum class RepairLevel {
    off,
    safe,  ///< no vertex moves (but 2^-45 of an edge, to close a needle without area) and no face
           ///< is cut: welds vertices at one place, drops faces without area and duplicates,
           ///< orients consistently
    full   ///< also joins near vertices and T-junctions, and resolves intersections and overlaps
};

struct RepairOptions {
    RepairLevel level = RepairLevel::full;
    Rounding rounding = Rounding::doubles;
    /// Over the scene's diagonal: of near vertices and T-junctions, of faces that overlap in one
    /// plane but for it, of edges that are collapsed where they make faces meet.
    double tolerance = usual_tolerance;
    bool close_cracks = true;  ///< full: join near vertices and T-junctions
    int rounds = 12;           ///< most times that rounding may be tried
};

/// What one pass did; passes that found nothing are not told.
struct RepairStep {
    std::string what;  ///< "dropped duplicate faces", ...
    std::uint64_t count = 0;
};

struct RepairReport {
    std::uint64_t welded = 0;  ///< vertices at the place of others: shared now, which is no defect
    double snapped_by = 0.0;   ///< the furthest any vertex was moved by rounding the input
    std::vector<RepairStep> steps;
    std::uint64_t crossing_pairs = 0, coplanar_pairs = 0;  ///< of triangles, as found at first
    std::uint64_t faces_cut = 0, faces_made = 0, vertices_made = 0;
    double largest_move = 0.0;      ///< the furthest any vertex was moved [scene units]
    int rounds = 0;                 ///< of resolution and rounding until nothing was left
    std::uint64_t pairs_left = 0;   ///< intersections that rounding made again each time
    std::vector<std::string> left;  ///< what was not repaired, and why

    [[nodiscard]] bool changed() const { return !steps.empty(); }
};

struct RepairedScene {
    /// Polygons that were not touched are the same, to the bit, in the same order; those that were
    /// became triangles with the material, object, source face and (interpolated) UVs of theirs.
    Scene scene;
    RepairReport report;
};

/// Runs the passes whose defects are present. \throws as require_extent.
[[nodiscard]] RepairedScene repair_scene(const Scene& scene, const RepairOptions& options,
                                         const Workers& workers, Monitor& monitor);

}  // namespace transillum
