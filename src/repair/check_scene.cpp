#include <transillum/repair/check_scene.h>
#include <transillum/repair/snap_grid.h>

#include "repair/defects/check_edges.h"
#include "repair/defects/find_components.h"
#include "repair/defects/find_defects.h"
#include "repair/defects/find_thin_walls.h"
#include "repair/exact/find_intersections.h"
#include "repair/leaks/find_leaks.h"
#include "repair/leaks/leak_sources.h"
#include "repair/repair_soup.h"

#include <transillum/base/error.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace transillum {

namespace {

/// Those of a position that several vertices of one object have.
void count_duplicate_vertices(const Scene& scene, const TriangleSoup& soup, const SoupCounts& met,
                              CheckReport& report) {
    constexpr auto at = static_cast<std::size_t>(Defect::duplicate_vertex);
    constexpr std::uint32_t none = 0xffffffffu;
    report.counts[at] = met.welded;
    std::vector<std::uint32_t> last(std::max(scene.positions.size(), soup.positions.size()), none);
    std::vector<std::uint64_t> before(report.objects.size(), 0), after(before);
    // Polygons of an object are mostly together, so that its last user says who has a vertex.
    for (const Polygon& polygon : scene.polygons)
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
            std::uint32_t& user = last[scene.corners[polygon.first_corner + c]];
            if (std::exchange(user, polygon.object) != polygon.object) ++before[polygon.object];
        }
    std::ranges::fill(last, none);
    for (const SoupTriangle& t : soup.triangles)
        for (const std::uint32_t v : t.vertices) {
            const std::uint32_t object = scene.polygons[t.polygon].object;
            if (std::exchange(last[v], object) != object) ++after[object];
        }
    for (std::size_t o = 0; o < before.size(); ++o)
        report.objects[o].counts[at] = before[o] - std::min(before[o], after[o]);
}

/// Height over the longest edge.
double thinness(const TriangleSoup& soup, std::uint32_t triangle) {
    const auto& v = soup.triangles[triangle].vertices;
    double longest = 0.0;
    for (int c = 0; c < 3; ++c)
        longest =
            std::max(longest, glm::length(soup.positions[v[(c + 1) % 3]] - soup.positions[v[c]]));
    return glm::length(area_vector(soup, triangle)) / longest / longest;
}

/// Counts faults and walls; \returns the soup without faulty faces and the later side of walls.
TriangleSoup check_faces(const Scene& scene, const TriangleSoup& soup, const CheckOptions& options,
                         DefectSites& sites) {
    const std::vector<FaultyFace> faults = find_faulty_faces(soup, scene);
    std::vector<bool> is_kept(faults.size());
    for (std::uint32_t t = 0; t < faults.size(); ++t) {
        const FaultyFace& fault = faults[t];
        is_kept[t] = fault.fault == FaceFault::none;
        switch (fault.fault) {
            case FaceFault::none:
                if (thinness(soup, t) < options.needle) sites.add_triangle(Defect::needle, t);
                break;
            case FaceFault::repeated_index:
                sites.add_triangle(Defect::repeated_index, t);
                break;
            case FaceFault::zero_area:
                sites.add_triangle(Defect::zero_area, t);
                break;
            case FaceFault::duplicate:
            case FaceFault::back:
                sites.add_pair(Defect::duplicate_face, t, fault.first);
                break;
            case FaceFault::opposite:
                sites.add_pair(Defect::opposite_face, t, fault.first);
                break;
        }
    }
    for (const auto& [first, later] : find_two_material_walls(soup, scene)) {
        sites.add_pair(Defect::two_material_wall, first, later);
        is_kept[later] = false;
    }
    std::vector<bool> gives_triangle(scene.polygons.size(), false);
    for (const SoupTriangle& t : soup.triangles) gives_triangle[t.polygon] = true;
    for (std::uint32_t p = 0; p < scene.polygons.size(); ++p)
        if (!gives_triangle[p]) sites.add_polygon(Defect::zero_area, p);
    TriangleSoup sound;
    sound.positions = soup.positions;
    for (std::uint32_t t = 0; t < faults.size(); ++t)
        if (is_kept[t]) sound.triangles.push_back(soup.triangles[t]);
    return sound;
}

void check_cracks(const TriangleSoup& soup, double tolerance, DefectSites& sites) {
    const std::vector<std::uint32_t> taken = find_near_vertices(soup, tolerance);
    const VertexCorners corners(soup);
    for (std::uint32_t v = 0; v < taken.size(); ++v) {
        if (taken[v] == v) continue;
        std::vector<std::uint32_t> triangles;
        for (const std::uint32_t vertex : {v, taken[v]})
            for (const std::uint32_t corner : corners[vertex]) triangles.push_back(corner / 3);
        sites.add_vertex(Defect::near_vertex, v, triangles);
    }
    std::vector<TJunction> junctions = find_t_junctions(soup, tolerance);
    std::ranges::stable_sort(junctions, {}, &TJunction::vertex);
    const auto is_same = [](const TJunction& a, const TJunction& b) {
        return a.vertex == b.vertex;
    };
    junctions.erase(std::unique(junctions.begin(), junctions.end(), is_same), junctions.end());
    for (const TJunction& t : junctions) {
        std::vector<std::uint32_t> triangles{t.triangle};
        for (const std::uint32_t corner : corners[t.vertex]) triangles.push_back(corner / 3);
        sites.add_vertex(Defect::t_junction, t.vertex, triangles);
    }
}

void check_components(const Scene& scene, const TriangleSoup& soup, CheckReport& report,
                      DefectSites& sites) {
    const EdgeTable edges(soup);
    const Sheets sheets = find_sheets(soup, edges);
    report.components = find_components(soup, scene, edges, sheets);
    std::vector<bool> is_known(sheets.size(), false);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const std::uint32_t s = sheets.sheet[t];
        if (is_known[s]) continue;
        is_known[s] = true;
        if (!sheets.orientable[s]) sites.add_triangle(Defect::non_orientable, t);
        if (report.components[s].volume < 0.0) sites.add_triangle(Defect::inside_out, t);
    }
}

std::vector<MeetingPair> check_intersections(const Scene& scene, const TriangleSoup& soup,
                                             const Workers& workers, DefectSites& sites) {
    std::vector<MeetingPair> pairs = find_intersections(soup, workers);
    const auto object_of = [&](std::uint32_t t) {
        return scene.polygons[soup.triangles[t].polygon].object;
    };
    for (const MeetingPair& pair : pairs) {
        const Defect defect = pair.kind == Meeting::overlap ? Defect::coplanar_overlap
                              : object_of(pair.a) == object_of(pair.b)
                                  ? Defect::self_intersection
                                  : Defect::object_intersection;
        sites.add_pair(defect, pair.a, pair.b);
    }
    return pairs;
}

void check_thin_walls(const TriangleSoup& soup, const std::vector<MeetingPair>& meetings,
                      const Workers& workers, CheckReport& report, DefectSites& sites) {
    for (const ThinWall& wall : find_thin_walls(soup, report.thin_wall, meetings, workers)) {
        sites.add_pair(Defect::thin_wall, wall.triangle, wall.behind);
        if (report.thinnest_wall == 0.0 || wall.thickness < report.thinnest_wall)
            report.thinnest_wall = wall.thickness;
    }
}

/// On a copy whose faces meet in whole edges; no gap is closed in it, however narrow.
void check_leaks(const Scene& scene, TriangleSoup soup, double leak_width, const Workers& workers,
                 Monitor& monitor, CheckReport& report) {
    RepairOptions exactly;
    exactly.close_cracks = false;
    RepairReport unused;
    repair_soup(soup, scene, exactly, {}, workers, monitor, unused);
    report.leaks = find_leaks(soup, scene, leak_width * report.diagonal, workers, monitor);
    report.leaks_searched = !soup.triangles.empty() && !monitor.stop_requested();
    report.counts[static_cast<std::size_t>(Defect::leak)] =
        static_cast<std::uint64_t>(std::ranges::count(report.leaks, false, &Leak::is_opening));
}

CheckReport start_report(const Scene& scene, const TriangleSoup& soup,
                         const CheckOptions& options) {
    CheckReport report;
    report.polygons = scene.polygons.size();
    report.triangles = soup.triangles.size();
    report.vertices = soup.positions.size();
    report.diagonal = diagonal_of(soup);
    report.tolerance = options.tolerance * report.diagonal;
    report.thin_wall = options.thin_wall * report.diagonal;
    for (const std::string& name : scene.objects) report.objects.push_back({name, 0, {}});
    for (const SoupTriangle& t : soup.triangles)
        ++report.objects[scene.polygons[t.polygon].object].triangles;
    return report;
}

}  // namespace

bool CheckReport::is_sound() const {
    for (std::size_t d = 0; d < defect_count; ++d)
        if (counts[d] > 0 && is_harmful(static_cast<Defect>(d))) return false;
    return true;
}

CheckReport check_scene(const Scene& scene, const CheckOptions& options, const Workers& workers,
                        Monitor& monitor) {
    if (scene.polygons.empty())
        throw InputError(scene.path, "there is no polygon; accepted: one or more");
    require_extent(scene);
    std::uint64_t steps_done = 0;
    const auto step = [&](std::string_view phase) { monitor.progress({phase, steps_done++, 0}); };
    step("check: faces");
    SoupCounts met;
    const TriangleSoup soup = make_soup(scene, &met);
    CheckReport report = start_report(scene, soup, options);
    count_duplicate_vertices(scene, soup, met, report);
    DefectSites all_sites(scene, soup, report);
    const TriangleSoup sound = check_faces(scene, soup, options, all_sites);
    DefectSites sites(scene, sound, report);
    step("check: edges");
    check_edges(soup, all_sites);
    check_cracks(sound, report.tolerance, sites);
    check_components(scene, sound, report, sites);
    step("check: intersections");
    const std::vector<MeetingPair> meetings = check_intersections(scene, sound, workers, sites);
    step("check: thin walls");
    check_thin_walls(sound, meetings, workers, report, sites);
    if (options.leaks && has_leak_sources(scene)) {
        step("check: leaks");
        check_leaks(scene, soup, options.leak_width, workers, monitor, report);
    }
    std::ranges::stable_sort(report.sites, {}, &DefectSite::defect);
    return report;
}

}  // namespace transillum
