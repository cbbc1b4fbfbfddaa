/// Small scenes for the tests, polygon by polygon.
#pragma once

#include <transillum/geometry/surface_mesh.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace transillum::testing_support {

using Outline = std::vector<glm::dvec3>;

/// Collects what a function says.
class Recorder : public Monitor {
public:
    void warn(const std::string& message) override { warnings.push_back(message); }
    void note(const std::string& message) override { notes.push_back(message); }
    std::vector<std::string> warnings, notes;
};

enum class Facing { inwards, outwards };

class SceneBuilder {
public:
    SceneBuilder() {
        scene.path = "test";
        scene.objects = {"object"};
        scene.materials.resize(1);
    }

    std::uint32_t material(Spectrum diffuse, Spectrum emission = Spectrum(0.0f)) {
        Material m;
        m.diffuse = diffuse;
        m.emission = emission;
        scene.materials.push_back(m);
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    }

    /// Counter-clockwise from its front; every corner is a position of its own.
    void polygon(const Outline& outline, std::uint32_t material = 0, std::uint32_t object = 0) {
        const auto first = static_cast<std::uint32_t>(scene.corners.size());
        for (const glm::dvec3& p : outline) {
            scene.corners.push_back(static_cast<std::uint32_t>(scene.positions.size()));
            scene.positions.push_back(p);
        }
        scene.polygons.push_back({first, static_cast<std::uint32_t>(outline.size()), material,
                                  object, static_cast<std::uint32_t>(scene.polygons.size())});
    }

    /// Floor (low z), ceiling, low y, high y, low x, high x; `left_out` is one of them, or -1.
    void box(glm::dvec3 low, glm::dvec3 high, Facing facing, std::uint32_t material = 0,
             int left_out = -1) {
        const auto at = [&](int x, int y, int z) {
            return glm::dvec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
        };
        const std::vector<Outline> inwards{{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)},
                                           {at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)},
                                           {at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)},
                                           {at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)},
                                           {at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)},
                                           {at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}};
        for (int i = 0; i < 6; ++i)
            if (i != left_out) turned_polygon(inwards[i], facing, material);
    }

    /// Meridians meet in a vertex at each pole.
    void sphere(glm::dvec3 centre, double radius, int meridians, Facing facing,
                std::uint32_t material = 0) {
        const int parallels = meridians / 2;
        const auto at = [&](int i, int j) {
            if (i == 0 || i == parallels) return centre + glm::dvec3(0, 0, i ? -radius : radius);
            const double theta = std::numbers::pi * i / parallels;
            const double phi = 2.0 * std::numbers::pi * (j % meridians) / meridians;
            return centre + radius * glm::dvec3(std::sin(theta) * std::cos(phi),
                                                std::sin(theta) * std::sin(phi), std::cos(theta));
        };
        for (int i = 0; i < parallels; ++i)
            for (int j = 0; j < meridians; ++j) {
                Outline p;
                for (const glm::dvec3& corner :
                     {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)})
                    if (p.empty() || p.back() != corner) p.push_back(corner);
                turned_polygon(p, facing, material);
            }
    }

    [[nodiscard]] SurfaceMesh surface(const SurfaceOptions& options = {},
                                      SurfaceReport* report = nullptr) const {
        Monitor silent;
        return build_surface(scene, options, silent, report);
    }

    Scene scene;

private:
    void turned_polygon(Outline outline, Facing facing, std::uint32_t material) {
        if (facing == Facing::outwards) outline = {outline.rbegin(), outline.rend()};
        polygon(outline, material);
    }
};

}  // namespace transillum::testing_support
