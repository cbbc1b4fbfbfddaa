#include "repair/defects/find_defects.h"
#include "unit/repair/placed_scene.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace transillum {
namespace {

using FlipsOf = testing_support::Placed;
using Turns = std::vector<bool>;

Flips flips_of(const Scene& scene) {
    return find_flips(make_soup(scene), scene);
}

Turns only(std::size_t n, const std::vector<std::size_t>& turned) {
    Turns turns(n, false);
    for (const std::size_t t : turned) turns[t] = true;
    return turns;
}

/// A strip of squares of one unit, in the plane z = 0; those named run the other way.
void add_strip(testing_support::PlacedScene& made, int squares, const std::vector<int>& turned,
               const std::vector<std::uint32_t>& materials = {}) {
    for (int i = 0; i < squares; ++i) {
        const double x = i;
        std::vector<glm::dvec3> outline{{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}};
        if (std::ranges::count(turned, i)) std::ranges::reverse(outline);
        made.polygon(outline, materials.empty() ? 0 : materials[i]);
    }
}

TEST_P(FlipsOf, ConsistentSheetsAreNone) {
    made.box({0, 0, 0}, {1, 1, 1}, true);
    made.box({2, 0, 0}, {3, 1, 1});
    const Flips flips = flips_of(made.scene);
    EXPECT_EQ(flips.turn, only(24, {}));
    EXPECT_EQ(flips.non_orientable, only(24, {}));
    EXPECT_EQ(flips.emits_both_ways, only(24, {}));
}

TEST_P(FlipsOf, TheSmallerAreaAreTurned) {
    add_strip(made, 4, {2});
    EXPECT_EQ(flips_of(made.scene).turn, only(8, {4, 5}));
}

TEST_P(FlipsOf, WhatWouldTurnAnEmitterAreNot) {
    const std::uint32_t lamp = made.material(1.0f);
    add_strip(made, 4, {2}, {0, 0, lamp, 0});
    EXPECT_EQ(flips_of(made.scene).turn, only(8, {0, 1, 2, 3, 6, 7}));
}

TEST_P(FlipsOf, WhatEmitsBothWaysAreNotAndAreTold) {
    const std::uint32_t lamp = made.material(1.0f);
    add_strip(made, 4, {2}, {lamp, 0, lamp, 0});
    const Flips flips = flips_of(made.scene);
    EXPECT_EQ(flips.turn, only(8, {}));
    EXPECT_EQ(std::ranges::count(flips.emits_both_ways, true), 8);
}

TEST_P(FlipsOf, ClosedSheetsOfNoMajorityTurnOutwards) {
    for (const bool inwards : {false, true}) {
        testing_support::PlacedScene cube(GetParam());
        cube.box({0, 0, 0}, {1, 1, 1}, inwards);
        Scene& scene = cube.scene;
        for (const std::size_t p : {1u, 2u, 4u}) {
            const auto first = scene.corners.begin() + scene.polygons[p].first_corner;
            std::reverse(first, first + 4);
        }
        const TriangleSoup soup = make_soup(scene);
        const Flips flips = find_flips(soup, scene);
        double volume = 0.0;
        const glm::dvec3 centre = cube.place({0.5, 0.5, 0.5});
        for (std::uint32_t t = 0; t < 12; ++t) {
            const glm::dvec3 corner = soup.positions[soup.triangles[t].vertices[0]] - centre;
            const double cone = glm::dot(corner, area_vector(soup, t)) / 6.0;
            volume += flips.turn[t] ? -cone : cone;
        }
        EXPECT_EQ(volume, std::pow(GetParam().scale, 3));
    }
}

TEST_P(FlipsOf, AMoebiusStripCannotBe) {
    constexpr int squares = 5;
    std::array<std::array<std::uint32_t, 2>, squares> rungs{};
    for (int i = 0; i < squares; ++i) {
        const double x = (i * i) % squares, y = i;
        rungs[i] = {made.vertex({x, y, 0}), made.vertex({x, y, 1})};
    }
    for (int i = 0; i < squares; ++i) {
        auto next = rungs[(i + 1) % squares];
        if (i + 1 == squares) std::swap(next[0], next[1]);
        made.face({rungs[i][0], next[0], next[1]});
        made.face({rungs[i][0], next[1], rungs[i][1]});
    }
    made.polygon({{10, 0, 0}, {11, 0, 0}, {10, 1, 0}});
    const Flips flips = flips_of(made.scene);
    EXPECT_EQ(flips.turn, only(11, {}));
    Turns twisted(11, true);
    twisted[10] = false;
    EXPECT_EQ(flips.non_orientable, twisted);
}

TEST_P(FlipsOf, SheetsThatMeetInAnEdgeOfThreeAreApart) {
    made.polygon({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}});
    made.polygon({{0, 0, 0}, {0, 0, 1}, {-1, 1, 0}});
    made.polygon({{0, 0, 0}, {0, 0, 1}, {-1, -1, 0}});
    EXPECT_EQ(flips_of(made.scene).turn, only(3, {}));
}

TRANSILLUM_AT_ALL_PLACES(FlipsOf);

}  // namespace
}  // namespace transillum
