/// Meshes made by hand, at any size and place that keeps their coordinates exact.
#pragma once

#include <transillum/scene/scene.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace transillum::testing_support {

/// Powers of two, so that integers and dyadic fractions stay what they are.
struct Placement {
    const char* name;
    double scale = 1.0;
    double shift = 0.0;  ///< along each axis, before scaling
};

inline void PrintTo(const Placement& p, std::ostream* out) {
    *out << p.name;
}

inline const std::array<Placement, 4> placements{{{"AsItIs", 1.0, 0.0},
                                                  {"Tiny", 0x1p-20, 0.0},
                                                  {"Huge", 0x1p20, 0.0},
                                                  {"FarAway", 1.0, 4096.0}}};

class PlacedScene {
public:
    explicit PlacedScene(const Placement& placement) : placement_(placement) {
        scene.path = "test";
        scene.objects = {"object"};
        scene.materials.resize(1);
    }

    [[nodiscard]] glm::dvec3 place(const glm::dvec3& p) const {
        return (p + placement_.shift) * placement_.scale;
    }

    std::uint32_t vertex(const glm::dvec3& p) {
        scene.positions.push_back(place(p));
        return static_cast<std::uint32_t>(scene.positions.size() - 1);
    }

    std::uint32_t material(float emission = 0.0f) {
        scene.materials.emplace_back().emission = Spectrum(emission);
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    }

    /// On vertices that there are.
    void face(const std::vector<std::uint32_t>& vertices, std::uint32_t material = 0,
              std::uint32_t object = 0) {
        const auto first = static_cast<std::uint32_t>(scene.corners.size());
        scene.corners.insert(scene.corners.end(), vertices.begin(), vertices.end());
        scene.polygons.push_back({first, static_cast<std::uint32_t>(vertices.size()), material,
                                  object, static_cast<std::uint32_t>(scene.polygons.size())});
        while (scene.objects.size() <= object)
            scene.objects.push_back("object " + std::to_string(scene.objects.size()));
    }

    void polygon(const std::vector<glm::dvec3>& outline, std::uint32_t material = 0,
                 std::uint32_t object = 0) {
        std::vector<std::uint32_t> vertices;
        for (const glm::dvec3& p : outline) vertices.push_back(vertex(p));
        face(vertices, material, object);
    }

    /// Six squares, fronts outwards; every corner is a position of its own.
    void box(const glm::dvec3& low, const glm::dvec3& high, bool inwards = false,
             std::uint32_t material = 0, std::uint32_t object = 0, int left_out = -1) {
        const auto at = [&](int i) {
            return glm::dvec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                              i & 4 ? high.z : low.z);
        };
        constexpr std::array<std::array<int, 4>, 6> sides{
            {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
        for (int s = 0; s < 6; ++s) {
            if (s == left_out) continue;
            std::vector<glm::dvec3> outline;
            for (int c = 0; c < 4; ++c) outline.push_back(at(sides[s][inwards ? 3 - c : c]));
            polygon(outline, material, object);
        }
    }

    Scene scene;

private:
    Placement placement_;
};

class Placed : public testing::TestWithParam<Placement> {
protected:
    PlacedScene made{GetParam()};
};

#define TRANSILLUM_AT_ALL_PLACES(suite)                                                    \
    INSTANTIATE_TEST_SUITE_P(Placements, suite,                                            \
                             testing::ValuesIn(::transillum::testing_support::placements), \
                             [](const auto& info) { return std::string(info.param.name); })

}  // namespace transillum::testing_support
