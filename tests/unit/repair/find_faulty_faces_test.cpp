#include "repair/defects/find_defects.h"
#include "unit/repair/placed_scene.h"

namespace transillum {
namespace {

using FaultyFaces = testing_support::Placed;

const std::vector<glm::dvec3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const std::vector<glm::dvec3> rotated{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
const std::vector<glm::dvec3> turned{{1, 0, 0}, {0, 0, 0}, {0, 1, 0}};

void expect_faults(const Scene& scene, const std::vector<FaultyFace>& expected) {
    const auto found = find_faulty_faces(make_soup(scene), scene);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].fault, expected[i].fault) << i;
        if (expected[i].fault >= FaceFault::duplicate) {
            EXPECT_EQ(found[i].first, expected[i].first) << i;
        }
    }
}

TEST_P(FaultyFaces, AreToldApart) {
    made.polygon(triangle);
    made.polygon({{0, 0, 0}, {0, 0, 0}, {0, 1, 0}});
    made.polygon({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}});
    made.polygon({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
    made.polygon(rotated);
    made.polygon(turned);
    made.polygon(turned);
    expect_faults(made.scene, {{FaceFault::none, 0},
                               {FaceFault::repeated_index, 0},
                               {FaceFault::zero_area, 0},
                               {FaceFault::none, 0},
                               {FaceFault::duplicate, 0},
                               {FaceFault::opposite, 0},
                               {FaceFault::duplicate, 0}});
}

TEST_P(FaultyFaces, AreThoseThatDoNotEmit) {
    const std::uint32_t lamp = made.material(1.0f);
    made.polygon(triangle);
    made.polygon(rotated, lamp);
    made.polygon(rotated, lamp);
    expect_faults(made.scene,
                  {{FaceFault::duplicate, 1}, {FaceFault::none, 0}, {FaceFault::duplicate, 1}});
}

TEST_P(FaultyFaces, AreNoWallsOfTwoMaterials) {
    const std::uint32_t other = made.material();
    made.polygon(triangle);
    made.polygon(turned, other);
    made.polygon(turned);
    made.polygon(triangle, other);
    expect_faults(made.scene, {{FaceFault::none, 0},
                               {FaceFault::none, 0},
                               {FaceFault::duplicate, 1},
                               {FaceFault::duplicate, 0}});
    const TriangleSoup soup = make_soup(made.scene);
    const auto walls = find_two_material_walls(soup, made.scene);
    ASSERT_EQ(walls.size(), 1u);
    EXPECT_EQ(walls[0], (std::array<std::uint32_t, 2>{0, 1}));
}

// What reflects from its back is kept, or turned to stand for the back of what emits.
TEST_P(FaultyFaces, TakeNoBackAway) {
    const std::uint32_t one_sided = made.material(), lamp = made.material(1.0f);
    made.scene.materials[one_sided].back_reflects = false;
    made.polygon(triangle, one_sided);
    made.polygon(rotated);
    expect_faults(made.scene, {{FaceFault::duplicate, 1}, {FaceFault::none, 0}});
    made.polygon(triangle, lamp);
    expect_faults(made.scene,
                  {{FaceFault::duplicate, 2}, {FaceFault::duplicate, 2}, {FaceFault::none, 0}});
    made.scene.materials[lamp].back_reflects = false;
    expect_faults(made.scene,
                  {{FaceFault::duplicate, 2}, {FaceFault::back, 2}, {FaceFault::none, 0}});
    made.polygon(triangle);
    made.polygon(turned, one_sided);
    expect_faults(made.scene, {{FaceFault::duplicate, 2},
                               {FaceFault::duplicate, 2},
                               {FaceFault::none, 0},
                               {FaceFault::duplicate, 2},
                               {FaceFault::none, 0}});
}

TRANSILLUM_AT_ALL_PLACES(FaultyFaces);

}  // namespace
}  // namespace transillum
