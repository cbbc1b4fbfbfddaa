#include "repair/defects/defect_sites.h"

#include <algorithm>

namespace transillum {

namespace {

std::uint64_t& at(DefectCounts& counts, Defect defect) {
    return counts[static_cast<std::size_t>(defect)];
}

}  // namespace

void DefectSites::add(const DefectSite& site, std::span<const std::uint32_t> triangles) {
    report_.sites.push_back(site);
    ++at(report_.counts, site.defect);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::uint32_t object = object_of(triangles[i]);
        const bool is_counted = std::ranges::any_of(
            triangles.first(i), [&](std::uint32_t t) { return object_of(t) == object; });
        if (!is_counted) ++at(report_.objects[object].counts, site.defect);
    }
}

void DefectSites::add_triangle(Defect defect, std::uint32_t triangle) {
    add_pair(defect, triangle, triangle);
}

void DefectSites::add_pair(Defect defect, std::uint32_t triangle, std::uint32_t other) {
    const SoupTriangle& t = soup_.triangles[triangle];
    const std::array<std::uint32_t, 2> both{triangle, other};
    add({defect, 3, t.vertices, t.polygon, soup_.triangles[other].polygon}, both);
}

void DefectSites::add_edge(Defect defect, std::span<const EdgeUse> uses) {
    std::vector<std::uint32_t> triangles;
    for (const EdgeUse& use : uses) triangles.push_back(use.triangle());
    add({defect,
         2,
         {uses.front().low, uses.front().high, uses.front().high},
         soup_.triangles[triangles.front()].polygon,
         soup_.triangles[triangles.back()].polygon},
        triangles);
}

void DefectSites::add_vertex(Defect defect, std::uint32_t vertex,
                             std::span<const std::uint32_t> triangles) {
    if (triangles.empty()) return;
    const std::uint32_t polygon = soup_.triangles[triangles.front()].polygon;
    const std::uint32_t other = soup_.triangles[triangles.back()].polygon;
    add({defect, 1, {vertex, vertex, vertex}, polygon, other}, triangles);
}

void DefectSites::add_polygon(Defect defect, std::uint32_t polygon) {
    report_.sites.push_back({defect, 0, {}, polygon, polygon});
    count(defect, 1, scene_.polygons[polygon].object);
}

void DefectSites::count(Defect defect, std::uint64_t count, std::uint32_t object) {
    at(report_.counts, defect) += count;
    at(report_.objects[object].counts, defect) += count;
}

}  // namespace transillum
