// Of faces on the same vertices no side is lost that reflects or emits.
#include "support/scene_builder.h"
#include "unit/repair/repaired.h"

#include <array>
#include <cmath>
#include <map>

namespace transillum {
namespace {

using testing_support::area_of;
using testing_support::expect_sound;
using testing_support::repair;
using testing_support::SceneBuilder;

TEST(RepairSides, KeepsTheEmitterOfAnOverlap) {
    SceneBuilder b;
    const auto lamp = b.material(Spectrum(0.0f), Spectrum(5.0f));
    b.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
    b.polygon({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}, lamp);
    const Scene repaired = repair(b.scene).scene;
    EXPECT_EQ(area_of(repaired), 16.0);
    double lit = 0.0;
    const TriangleSoup soup = make_soup(repaired);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
        if (repaired.materials[repaired.polygons[soup.triangles[t].polygon].material].emits())
            lit += 0.5 * area_vector(soup, t).z;
    EXPECT_EQ(lit, 1.0);
}

TEST(RepairSides, MakesTwoSidesOfFacesBackToBack) {
    SceneBuilder b;
    b.scene.materials[0].back_reflects = false;
    const auto other = b.material(Spectrum(0.1f));
    b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    b.polygon({{0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}});
    b.polygon({{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}});
    b.polygon({{0, 1, 2}, {1, 1, 2}, {1, 0, 2}, {0, 0, 2}}, other);  // a side of each material
    const Scene repaired = repair(b.scene).scene;
    EXPECT_EQ(area_of(repaired), 3.0);
    const Material& m = repaired.materials[repaired.polygons[0].material];
    EXPECT_TRUE(m.back_reflects);
    EXPECT_FALSE(repaired.materials[0].back_reflects);
    EXPECT_FALSE(repaired.materials[repaired.polygons[1].material].back_reflects);
}

/// Area of what faces up and down, by material.
std::map<std::uint32_t, std::array<double, 2>> areas_facing(const Scene& scene) {
    std::map<std::uint32_t, std::array<double, 2>> areas;
    const TriangleSoup soup = make_soup(scene);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const double z = 0.5 * area_vector(soup, t).z;
        areas[scene.polygons[soup.triangles[t].polygon].material][z > 0.0 ? 0 : 1] += std::abs(z);
    }
    return areas;
}

/// Whole and where they overlap in part.
TEST(RepairSides, KeepsBothSidesOfWallsOfTwoMaterials) {
    for (const RepairLevel level : {RepairLevel::safe, RepairLevel::full})
        for (const double shift : {0.0, 0.5}) {
            if (level == RepairLevel::safe && shift > 0.0) continue;  // cuts nothing
            SceneBuilder b;
            const auto other = b.material(Spectrum(0.1f));
            for (Material& m : b.scene.materials) m.back_reflects = false;
            b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
            b.polygon({{shift, 1, 0}, {shift + 1, 1, 0}, {shift + 1, 0, 0}, {shift, 0, 0}}, other);
            RepairOptions options;
            options.level = level;
            const Scene repaired = repair(b.scene, options).scene;
            const auto areas = areas_facing(repaired);
            ASSERT_EQ(areas.size(), 2u);
            EXPECT_EQ(areas.at(0), (std::array<double, 2>{1.0, 0.0}));
            EXPECT_EQ(areas.at(other), (std::array<double, 2>{0.0, 1.0}));
            for (const Polygon& p : repaired.polygons)
                EXPECT_FALSE(repaired.materials[p.material].back_reflects);
            expect_sound(repaired);
        }
}

/// A lamp of one side on a wall of two: seen from behind, the wall is whole.
TEST(RepairSides, KeepsTheBackOfAWallBehindALamp) {
    SceneBuilder b;
    const auto lamp = b.material(Spectrum(0.0f), Spectrum(5.0f));
    b.scene.materials[lamp].back_reflects = false;
    b.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
    b.polygon({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}, lamp);
    const Scene repaired = repair(b.scene).scene;
    const auto areas = areas_facing(repaired);
    EXPECT_EQ(areas.at(0), (std::array<double, 2>{15.0, 1.0}));
    EXPECT_EQ(areas.at(lamp), (std::array<double, 2>{1.0, 0.0}));
    expect_sound(repaired);
}

/// A poster of one side on a wall of two.
TEST(RepairSides, KeepsDuplicatesThatReflectFromTheirBacks) {
    SceneBuilder b;
    const auto poster = b.material(Spectrum(0.1f));
    b.scene.materials[poster].back_reflects = false;
    b.polygon({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}, poster);
    b.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
    const auto areas = areas_facing(repair(b.scene).scene);
    EXPECT_EQ(areas.size(), 1u);
    EXPECT_EQ(areas.at(0), (std::array<double, 2>{16.0, 0.0}));
}

/// What stands for both sides hands that on to what takes its place.
TEST(RepairSides, KeepsTwoSidesWhereDuplicatesGo) {
    SceneBuilder b;
    b.scene.materials[0].back_reflects = false;
    b.polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
    b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    b.polygon({{0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}});
    const Scene repaired = repair(b.scene).scene;
    const TriangleSoup soup = make_soup(repaired);
    double one = 0.0, two = 0.0;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const Polygon& p = repaired.polygons[soup.triangles[t].polygon];
        (repaired.materials[p.material].back_reflects ? two : one) +=
            0.5 * glm::length(area_vector(soup, t));
    }
    EXPECT_EQ(one, 3.0);
    EXPECT_EQ(two, 1.0);
}

}  // namespace
}  // namespace transillum
