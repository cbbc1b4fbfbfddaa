#include "benchmarks/scenes.h"

#include <cmath>
#include <numbers>

namespace transillum::benchmarks {

namespace {

void add_polygon(Scene& scene, const std::vector<std::uint32_t>& corners) {
    scene.polygons.push_back({static_cast<std::uint32_t>(scene.corners.size()),
                              static_cast<std::uint32_t>(corners.size()), 0, 0,
                              static_cast<std::uint32_t>(scene.polygons.size())});
    scene.corners.insert(scene.corners.end(), corners.begin(), corners.end());
}

void add_polygon(Scene& scene, const std::vector<glm::dvec3>& corners) {
    std::vector<std::uint32_t> numbers;
    for (const glm::dvec3& p : corners) {
        numbers.push_back(static_cast<std::uint32_t>(scene.positions.size()));
        scene.positions.push_back(p);
    }
    add_polygon(scene, numbers);
}

/// The unit cube, fronts inwards.
void add_room(Scene& scene) {
    const auto p = [](int x, int y, int z) { return glm::dvec3(x, y, z); };
    add_polygon(scene, {p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0)});
    add_polygon(scene, {p(0, 0, 1), p(0, 1, 1), p(1, 1, 1), p(1, 0, 1)});
    add_polygon(scene, {p(0, 0, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1)});
    add_polygon(scene, {p(1, 0, 0), p(1, 0, 1), p(1, 1, 1), p(1, 1, 0)});
    add_polygon(scene, {p(0, 0, 0), p(0, 0, 1), p(1, 0, 1), p(1, 0, 0)});
    add_polygon(scene, {p(0, 1, 0), p(1, 1, 0), p(1, 1, 1), p(0, 1, 1)});
}

void add_sphere(Scene& scene, const glm::dvec3& centre, double radius, int rings) {
    const int segments = 2 * rings;
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (int r = 0; r <= rings; ++r)
        for (int s = 0; s < (r == 0 || r == rings ? 1 : segments); ++s) {
            const double theta = std::numbers::pi * r / rings;
            const double phi = 2.0 * std::numbers::pi * s / segments;
            const double sine = r == 0 || r == rings ? 0.0 : std::sin(theta);
            scene.positions.push_back(centre + radius * glm::dvec3(sine * std::cos(phi),
                                                                   sine * std::sin(phi),
                                                                   std::cos(theta)));
        }
    const auto at = [&](int ring, int segment) {
        if (ring == 0) return first;
        const int before = 1 + (ring - 1) * segments;
        return first +
               static_cast<std::uint32_t>(before + (ring == rings ? 0 : segment % segments));
    };
    for (int r = 0; r < rings; ++r)
        for (int s = 0; s < segments; ++s) {
            if (r > 0) add_polygon(scene, {at(r, s), at(r + 1, s), at(r, s + 1)});
            if (r + 1 < rings) add_polygon(scene, {at(r, s + 1), at(r + 1, s), at(r + 1, s + 1)});
        }
}

}  // namespace

Scene scene_of_spheres(int spheres, int rings) {
    Scene scene;
    scene.path = "room of spheres";
    scene.objects = {"room"};
    scene.materials.resize(1);
    scene.materials[0].emission = Spectrum(1.0f);
    add_room(scene);
    for (int i = 0; i < spheres * spheres * spheres; ++i) {
        const glm::dvec3 cell(i % spheres, i / spheres % spheres, i / spheres / spheres);
        add_sphere(scene, (cell + 0.5) / double(spheres), 0.35 / spheres, rings);
    }
    return scene;
}

SurfaceMesh room_of_spheres(int spheres, int rings) {
    Monitor silent;
    return build_surface(scene_of_spheres(spheres, rings), {}, silent);
}

}  // namespace transillum::benchmarks
