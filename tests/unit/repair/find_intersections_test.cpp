// Pairs of triangles, against exact intersections of another kind (CGAL's constructions).
#include "repair/exact/find_intersections.h"

#include "unit/repair/random_soups.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <variant>

namespace transillum {
namespace {

using testing_support::grid_soup;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

Exact::Point_3 at(const TriangleSoup& soup, std::uint32_t v) {
    const glm::dvec3& p = soup.positions[v];
    return {p.x, p.y, p.z};
}

Exact::Triangle_3 triangle(const TriangleSoup& soup, std::uint32_t t) {
    const auto& v = soup.triangles[t].vertices;
    return {at(soup, v[0]), at(soup, v[1]), at(soup, v[2])};
}

enum class Expected { apart, meeting, overlapping };

/// What CGAL says that two triangles share, without what their shared vertices account for.
Expected expected(const TriangleSoup& soup, std::uint32_t a, std::uint32_t b) {
    std::vector<Exact::Point_3> shared;
    for (const std::uint32_t v : soup.triangles[b].vertices)
        if (std::ranges::count(soup.triangles[a].vertices, v) > 0) shared.push_back(at(soup, v));
    const auto is_shared = [&](const Exact::Point_3& p) {
        return std::ranges::count(shared, p) > 0;
    };
    const auto common = CGAL::intersection(triangle(soup, a), triangle(soup, b));
    if (!common) return Expected::apart;
    if (const auto* p = boost::get<Exact::Point_3>(&*common))
        return is_shared(*p) ? Expected::apart : Expected::meeting;
    if (const auto* s = boost::get<Exact::Segment_3>(&*common))
        return is_shared(s->source()) && is_shared(s->target()) ? Expected::apart
                                                                : Expected::meeting;
    return Expected::overlapping;
}

/// Small integer coordinates meet in every degenerate way there is.
TEST(FindIntersections, AgreesWithExactConstructions) {
    std::array<int, 3> met{};
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        const TriangleSoup soup = grid_soup(40, seed % 2 ? 3 : 5, seed);
        const std::vector<MeetingPair> pairs = find_intersections(soup, Workers(2));
        for (std::uint32_t b = 1; b < soup.triangles.size(); ++b)
            for (std::uint32_t a = 0; a < b; ++a) {
                const auto found = std::ranges::find_if(
                    pairs, [&](const MeetingPair& p) { return p.a == a && p.b == b; });
                const Expected wanted = expected(soup, a, b);
                ++met[static_cast<std::size_t>(wanted)];
                const Expected is = found == pairs.end()              ? Expected::apart
                                    : found->kind == Meeting::overlap ? Expected::overlapping
                                                                      : Expected::meeting;
                ASSERT_EQ(is, wanted) << "seed " << seed << ", " << a << " and " << b;
            }
    }
    for (const int count : met) EXPECT_GT(count, 200);
}

TriangleSoup two(std::vector<glm::dvec3> positions, std::array<std::uint32_t, 3> a,
                 std::array<std::uint32_t, 3> b) {
    return {std::move(positions), {{a, 0}, {b, 1}}, {}};
}

std::vector<MeetingPair> pairs_of(const TriangleSoup& soup) {
    return find_intersections(soup, Workers(1));
}

TEST(FindIntersections, TellsTouchingFromCrossing) {
    const std::vector<glm::dvec3> floor{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const auto with = [&](std::vector<glm::dvec3> more) {
        more.insert(more.begin(), floor.begin(), floor.end());
        return two(std::move(more), {0, 1, 2}, {3, 4, 5});
    };
    using Pairs = std::vector<MeetingPair>;
    EXPECT_EQ(pairs_of(with({{1, 1, 0}, {1, 2, 1}, {2, 1, 1}})),
              (Pairs{{0, 1, Meeting::touching}}));  // stands on a corner
    EXPECT_EQ(pairs_of(with({{1, 1, 0}, {2, 1, 0}, {1, 1, 1}})),
              (Pairs{{0, 1, Meeting::touching}}));  // stands on an edge
    EXPECT_EQ(pairs_of(with({{1, 1, -1}, {2, 1, -1}, {1, 1, 1}})),
              (Pairs{{0, 1, Meeting::crossing}}));
    EXPECT_EQ(pairs_of(with({{2, -1, 0}, {2, 1, -1}, {2, 1, 1}})),
              (Pairs{{0, 1, Meeting::crossing}}));  // through the border
    EXPECT_EQ(pairs_of(with({{2, 0, -1}, {2, 0, 1}, {2, -1, 0}})),
              (Pairs{{0, 1, Meeting::touching}}));  // edges cross in one point
    EXPECT_EQ(pairs_of(with({{1, 1, 0}, {5, 1, 0}, {1, 5, 0}})), (Pairs{{0, 1, Meeting::overlap}}));
    EXPECT_EQ(pairs_of(with({{1, 0, 0}, {3, 0, 0}, {2, -1, 0}})),
              (Pairs{{0, 1, Meeting::touching}}));  // a part of one edge
    EXPECT_TRUE(pairs_of(with({{1, 1, 0x1p-60}, {2, 1, 1}, {1, 2, 1}})).empty());
}

TEST(FindIntersections, LetsNeighboursBe) {
    const std::vector<glm::dvec3> p{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 1, 0}};
    EXPECT_TRUE(pairs_of(two(p, {0, 1, 2}, {1, 0, 3})).empty());  // an edge
    EXPECT_TRUE(pairs_of(two(p, {0, 1, 2}, {0, 2, 1})).empty());  // two materials on one face
    EXPECT_EQ(pairs_of(two(p, {0, 1, 2}, {0, 1, 4})).at(0).kind, Meeting::overlap);  // folded over
    EXPECT_EQ(pairs_of(two(p, {0, 1, 2}, {0, 4, 3})).at(0).kind, Meeting::touching);
}

TEST(FindIntersections, StopsWhereThereAreTooMany) {
    TriangleSoup fan;
    for (std::uint32_t i = 0; i < 2000; ++i) {  // all through the z axis
        const double x = 1.0 + 0.001 * i;
        fan.positions.insert(fan.positions.end(), {{x, i, -1}, {x, i, 1}, {-x, -1.0 * i, 0}});
        fan.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, i});
    }
    EXPECT_EQ(pairs_of(fan).size(), 2000u * 1999u / 2);
    EXPECT_LT(find_intersections(fan, Workers(1), 1000).size(), 2000u * 1999u / 2);
    EXPECT_GT(find_intersections(fan, Workers(1), 1000).size(), 1000u);
}

}  // namespace
}  // namespace transillum
