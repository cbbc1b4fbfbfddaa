/// Writes defects down as they are found.
#pragma once

#include "repair/defects/edge_table.h"

#include <transillum/repair/check_scene.h>

#include <span>

namespace transillum {

/// Counts in all and for every object that has a part in it, and keeps the site.
class DefectSites {
public:
    DefectSites(const Scene& scene, const TriangleSoup& soup, CheckReport& report)
        : scene_(scene), soup_(soup), report_(report) {}

    void add_triangle(Defect defect, std::uint32_t triangle);
    /// Of two triangles; the site is the first.
    void add_pair(Defect defect, std::uint32_t triangle, std::uint32_t other);
    void add_edge(Defect defect, std::span<const EdgeUse> uses);
    /// \param triangles that it belongs to
    void add_vertex(Defect defect, std::uint32_t vertex, std::span<const std::uint32_t> triangles);
    /// Of a polygon that gives no triangle.
    void add_polygon(Defect defect, std::uint32_t polygon);
    /// Counts without a site.
    void count(Defect defect, std::uint64_t count, std::uint32_t object);

private:
    void add(const DefectSite& site, std::span<const std::uint32_t> triangles);
    [[nodiscard]] std::uint32_t object_of(std::uint32_t triangle) const {
        return scene_.polygons[soup_.triangles[triangle].polygon].object;
    }

    const Scene& scene_;
    const TriangleSoup& soup_;
    CheckReport& report_;
};

}  // namespace transillum
