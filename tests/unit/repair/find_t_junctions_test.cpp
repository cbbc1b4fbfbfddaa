#include "repair/defects/find_defects.h"
#include "unit/repair/placed_scene.h"

namespace transillum {
namespace {

using TJunctions = testing_support::Placed;

constexpr double gap = 0x1p-24;

TEST_P(TJunctions, AreFoundOnTheEdgeThatIsPassedBy) {
    made.polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    made.polygon({{0, 0, 0}, {1, 0, 0}, {0, -4, 0}});
    made.polygon({{1, gap, 0}, {3, 0, 0}, {2, -4, 0}});  // within the tolerance
    made.polygon({{3, 0, 0}, {4, 0, 0}, {4, -4, 0}});
    const auto found = find_t_junctions(make_soup(made.scene), 2 * gap * GetParam().scale);
    // Vertices: 3 = (1 0 0), 5 = (1 gap 0), 6 = (3 0 0).
    ASSERT_EQ(found.size(), 3u);
    const std::array<std::uint32_t, 3> vertices{3, 5, 6};
    const std::array<double, 3> parameters{0.25, 0.25, 0.75};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(found[i].triangle, 0u);
        EXPECT_EQ(found[i].edge, 0u);
        EXPECT_EQ(found[i].vertex, vertices[i]);
        EXPECT_EQ(found[i].parameter, parameters[i]);
    }
}

TEST_P(TJunctions, NeedABorderOnBothSides) {
    // The middle of the edge of two faces; a vertex in the middle of a closed fan.
    made.polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    made.polygon({{4, 0, 0}, {0, 0, 0}, {0, -4, 0}});
    made.polygon({{2, 0, 0}, {2, 1, 4}, {3, 1, 4}});
    EXPECT_TRUE(find_t_junctions(make_soup(made.scene), gap * GetParam().scale).empty());
}

TEST_P(TJunctions, AreNotAtTheEndsNorFurtherOff) {
    made.polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    made.polygon({{gap, 0, 4}, {gap, -gap, 0}, {-4, -4, 4}});  // at an end
    made.polygon({{2, -4 * gap, 0}, {3, -8, 0}, {2, -8, 1}});  // four tolerances below
    EXPECT_TRUE(find_t_junctions(make_soup(made.scene), 2 * gap * GetParam().scale).empty());
    EXPECT_EQ(find_t_junctions(make_soup(made.scene), 4 * gap * GetParam().scale).size(), 1u);
}

TRANSILLUM_AT_ALL_PLACES(TJunctions);

}  // namespace
}  // namespace transillum
