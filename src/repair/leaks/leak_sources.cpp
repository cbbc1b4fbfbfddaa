#include "repair/leaks/leak_sources.h"

#include "repair/leaks/side_ways.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace transillum {

namespace {

std::string quoted(const char* what, const std::string& name) {
    return std::string(what) + " '" + name + "'";
}

std::vector<LeakSource> find_luminaires(const TriangleSoup& soup, const Scene& scene) {
    std::vector<LeakSource> of_object(scene.objects.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const Polygon& polygon = scene.polygons[soup.triangles[t].polygon];
        const Material& material = scene.materials[polygon.material];
        if (!material.emits()) continue;
        LeakSource& source = of_object[polygon.object];
        if (source.sides.empty()) source.name = quoted("luminaire", scene.objects[polygon.object]);
        source.sides.push_back(2 * t);
        if (material.back_emits || soup.triangles[t].both_sides) source.sides.push_back(2 * t + 1);
    }
    std::erase_if(of_object, [](const LeakSource& source) { return source.sides.empty(); });
    return of_object;
}

LeakSource look_around(const TriangleSoup& soup, const TriangleTree& tree, std::string name,
                       const glm::dvec3& position, const std::vector<glm::dvec3>& directions) {
    LeakSource source{std::move(name), {}, {}, position, {}};
    for (const glm::dvec3& direction : directions) {
        const auto hit = tree.first_hit(position, direction, [](std::uint32_t) { return false; });
        if (!hit) {
            source.free.push_back(direction);
            continue;
        }
        source.sides.push_back(side_met(soup, hit->triangle, direction));
        source.seen_at.push_back(position + hit->distance * direction);
    }
    return source;
}

}  // namespace

bool has_leak_sources(const Scene& scene) {
    return !scene.cameras.empty() ||
           std::ranges::any_of(
               scene.lighting.lights,
               [](const PunctualLight& l) { return l.kind != PunctualLight::Kind::directional; }) ||
           std::ranges::any_of(scene.polygons, [&](const Polygon& p) {
               return scene.materials[p.material].emits();
           });
}

std::vector<LeakSource> find_leak_sources(const TriangleSoup& soup, const Scene& scene,
                                          const TriangleTree& tree, double reach) {
    std::vector<LeakSource> sources = find_luminaires(soup, scene);
    for (const PunctualLight& light : scene.lighting.lights) {
        if (light.kind == PunctualLight::Kind::directional) continue;
        std::vector<glm::dvec3> directions;
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {1.0, -1.0}) {
                directions.emplace_back(0.0)[axis] = sign * reach;
            }
        sources.push_back(
            look_around(soup, tree, quoted("light", light.name), light.position, directions));
    }
    for (const Camera& camera : scene.cameras) {
        const glm::dvec3 ahead = glm::normalize(camera.look_at - camera.eye);
        sources.push_back(
            look_around(soup, tree, quoted("camera", camera.name), camera.eye, {reach * ahead}));
    }
    return sources;
}

}  // namespace transillum
