/// Small surfaces for the tests, corner by corner.
#pragma once

#include <transillum/geometry/surface_mesh.h>

#include <map>
#include <tuple>

namespace transillum::testing_support {

class SurfaceBuilder {
public:
    std::uint32_t material(Spectrum diffuse, Spectrum emission = Spectrum(0.0f)) {
        Material m;
        m.diffuse = diffuse;
        m.emission = emission;
        mesh_.materials.push_back(m);
        return static_cast<std::uint32_t>(mesh_.materials.size() - 1);
    }
    Material& operator[](std::uint32_t material) { return mesh_.materials[material]; }

    /// A quadrilateral, counter-clockwise from its front. Those of one smoothing group share their
    /// fans.
    void quad(const std::array<glm::dvec3, 4>& p, std::uint32_t material, int group) {
        triangle({p[0], p[1], p[2]}, material, group);
        triangle({p[0], p[2], p[3]}, material, group);
    }
    void triangle(const std::array<glm::dvec3, 3>& p, std::uint32_t material, int group) {
        RootTriangle t;
        for (int c = 0; c < 3; ++c) {
            t.vertices[c] = number(vertices_, {p[c].x, p[c].y, p[c].z, 0});
            if (t.vertices[c] == mesh_.positions.size()) mesh_.positions.push_back(p[c]);
            t.fans[c] = number(fans_, {p[c].x, p[c].y, p[c].z, group});
        }
        t.material = material;
        mesh_.triangles.push_back(t);
    }
    /// The inside of an axis-aligned box: floor (z = low), ceiling, then the walls, all facing
    /// inwards.
    void room(glm::dvec3 low, glm::dvec3 high, const std::array<std::uint32_t, 6>& materials) {
        const auto at = [&](int x, int y, int z) {
            return glm::dvec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
        };
        quad({at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}, materials[0], 1);
        quad({at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)}, materials[1], 2);
        quad({at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)}, materials[2], 3);
        quad({at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}, materials[3], 4);
        quad({at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}, materials[4], 5);
        quad({at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}, materials[5], 6);
    }
    SurfaceMesh build() {
        mesh_.fan_count = static_cast<std::uint32_t>(fans_.size());
        return mesh_;
    }

private:
    using Key = std::tuple<double, double, double, int>;
    static std::uint32_t number(std::map<Key, std::uint32_t>& numbers, const Key& key) {
        return numbers.try_emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second;
    }
    SurfaceMesh mesh_;
    std::map<Key, std::uint32_t> vertices_, fans_;
};

}  // namespace transillum::testing_support
