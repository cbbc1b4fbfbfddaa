/// Triangles at random.
#pragma once

#include <transillum/repair/triangle_soup.h>

#include <array>
#include <map>
#include <random>
#include <set>

namespace transillum::testing_support {

/// With corners of integer coordinates in [0, size): they touch, overlap and share vertices often.
/// None is without area, no two are on the same corners. Polygon = number of the triangle.
inline TriangleSoup grid_soup(std::uint32_t count, int size, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto coordinate = [&] {
        return static_cast<double>(random() % static_cast<unsigned>(size));
    };
    TriangleSoup soup;
    std::map<std::array<double, 3>, std::uint32_t> vertices;
    std::set<std::set<std::uint32_t>> seen;
    while (soup.triangles.size() < count) {
        SoupTriangle t{{}, static_cast<std::uint32_t>(soup.triangles.size())};
        for (std::uint32_t& v : t.vertices) {
            const std::array<double, 3> p{coordinate(), coordinate(), coordinate()};
            const auto [at, is_new] =
                vertices.try_emplace(p, static_cast<std::uint32_t>(soup.positions.size()));
            if (is_new) soup.positions.emplace_back(p[0], p[1], p[2]);
            v = at->second;
        }
        soup.triangles.push_back(t);
        const std::set<std::uint32_t> corners(t.vertices.begin(), t.vertices.end());
        if (!has_area(soup, t.polygon) || !seen.insert(corners).second) soup.triangles.pop_back();
    }
    return soup;
}

/// The same as a scene: a polygon a triangle, whose UVs are its x and y over 8.
inline Scene scene_of(const TriangleSoup& soup, std::uint32_t materials = 1) {
    Scene scene;
    scene.path = "soup";
    scene.positions = soup.positions;
    scene.materials.resize(materials);
    for (std::uint32_t m = 0; m < materials; ++m) scene.materials[m].name = std::to_string(m);
    scene.objects = {"even", "odd"};
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        scene.polygons.push_back({3 * t, 3, t % materials, t % 2, t});
        for (const std::uint32_t v : soup.triangles[t].vertices) {
            scene.corners.push_back(v);
            scene.uvs.emplace_back(glm::vec2(soup.positions[v]) / 8.0f);
        }
    }
    return scene;
}

}  // namespace transillum::testing_support
