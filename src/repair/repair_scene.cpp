#include <transillum/repair/repair_scene.h>

#include "repair/repair_soup.h"
#include "repair/restore_polygons.h"

namespace transillum {

RepairedScene repair_scene(const Scene& scene, const RepairOptions& options, const Workers& workers,
                           Monitor& monitor) {
    RepairedScene repaired{scene, {}};
    RepairReport& report = repaired.report;
    if (options.level == RepairLevel::off) return repaired;
    require_extent(scene);
    const SnapGrid grid = snap_scene(repaired.scene, options.rounding);
    report.snapped_by = report.largest_move = grid.largest_move;
    SoupCounts counts;
    const TriangleSoup made = make_soup(repaired.scene, &counts);
    report.welded = counts.welded;
    if (counts.without_area > 0)
        report.steps.push_back({"dropped polygons without area", counts.without_area});
    TriangleSoup soup = made;
    repair_soup(soup, repaired.scene, options, grid, workers, monitor, report);
    if (report.changed() || report.welded > 0)
        repaired.scene = restore_polygons(repaired.scene, made, soup);
    return repaired;
}

}  // namespace transillum
