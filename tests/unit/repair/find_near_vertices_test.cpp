#include "repair/defects/find_defects.h"
#include "unit/repair/placed_scene.h"

#include <numeric>

namespace transillum {
namespace {

using NearVertices = testing_support::Placed;
using Indices = std::vector<std::uint32_t>;

constexpr double gap = 0x1p-24;  // exact beside 4096

Indices all_of(std::size_t n) {
    Indices indices(n);
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
}

TEST_P(NearVertices, AreTakenForTheEarlierOne) {
    made.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    made.polygon({{1 + gap, 0, 0}, {1, 1, 0}, {0, 1 + 4 * gap, 0}});
    const TriangleSoup soup = make_soup(made.scene);
    Indices expected = all_of(6);
    expected[3] = 1;
    EXPECT_EQ(find_near_vertices(soup, 2 * gap * GetParam().scale), expected);
    expected[5] = 2;
    EXPECT_EQ(find_near_vertices(soup, 4 * gap * GetParam().scale), expected);
    EXPECT_EQ(find_near_vertices(soup, 0.0), all_of(6));
}

TEST_P(NearVertices, OfOneTriangleAreKeptApart) {
    made.polygon({{0, 0, 0}, {gap, 0, 0}, {0, 1, 0}});
    // One vertex near both ends of that edge, and one that lies between: only one may join each.
    made.polygon({{0, -gap, 0}, {1, -1, 0}, {1, 0, 0}});
    const TriangleSoup soup = make_soup(made.scene);
    Indices expected = all_of(6);
    expected[3] = 0;
    EXPECT_EQ(find_near_vertices(soup, 8 * gap * GetParam().scale), expected);
}

TEST_P(NearVertices, OfOneTriangleAreNotJoinedByWayOfAThird) {
    made.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    made.polygon({{gap, 0, 0}, {0, gap, 0}, {-1, 1, 0}});
    Indices expected = all_of(6);
    expected[3] = 0;  // and 4, of the same triangle as 3, is not
    EXPECT_EQ(find_near_vertices(make_soup(made.scene), 8 * gap * GetParam().scale), expected);
}

TEST_P(NearVertices, JoinInChainsOnlyAsFarAsTheTolerance) {
    for (int i = 0; i < 8; ++i)
        made.polygon({{i * gap, 0, 0}, {1.0 + i, 1, 0}, {1.0 + i, 2, 1.0 + i}});
    const auto taken = find_near_vertices(make_soup(made.scene), 2.5 * gap * GetParam().scale);
    for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(taken[3 * i], 3 * (i - i % 3));
}

using ShortEdges = testing_support::Placed;

// A fan whose rim runs in steps of a gap: they join in turn, as far as the tolerance.
TEST_P(ShortEdges, AreCollapsedOneByOne) {
    const std::uint32_t tip = made.vertex({0, 1, 0});
    for (int i = 0; i < 8; ++i) made.vertex({i * gap, 0, 0});
    for (std::uint32_t i = 1; i < 8; ++i) made.face({tip, i, i + 1});
    const TriangleSoup soup = make_soup(made.scene);
    const std::vector<bool> all(9, true);
    const double tolerance = 2.5 * gap * GetParam().scale;
    EXPECT_EQ(find_short_edges(soup, all, tolerance), (Indices{0, 1, 1, 1, 4, 4, 4, 7, 7}));
    EXPECT_EQ(find_short_edges(soup, all, 0.0), all_of(9));
    std::vector<bool> some(9, false);
    some[5] = some[6] = some[8] = true;
    EXPECT_EQ(find_short_edges(soup, some, tolerance), (Indices{0, 1, 2, 3, 4, 5, 5, 7, 8}));
}

TEST_P(ShortEdges, AreNotAcrossCracks) {
    made.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    made.polygon({{gap, 0, 0}, {1, -1, 0}, {1 + gap, 0, 0}});
    const TriangleSoup soup = make_soup(made.scene);
    EXPECT_EQ(find_short_edges(soup, std::vector<bool>(6, true), 2 * gap * GetParam().scale),
              all_of(6));
}

// Cells of the search are then more than doubles can count.
TEST_P(NearVertices, AreSoughtWithinTheLeastOfTolerances) {
    made.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    made.polygon({{1, 1, 0}, {2, 1, 0}, {1, 2, 0}});
    const TriangleSoup soup = make_soup(made.scene);
    for (const double tolerance : {1e-20, 1e-300}) {
        const auto taken = find_near_vertices(soup, tolerance * GetParam().scale);
        for (std::uint32_t v = 0; v < taken.size(); ++v) EXPECT_EQ(taken[v], v);
    }
}

TRANSILLUM_AT_ALL_PLACES(NearVertices);
TRANSILLUM_AT_ALL_PLACES(ShortEdges);

}  // namespace
}  // namespace transillum
