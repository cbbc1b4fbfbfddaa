#include "repair/leaks/gap_width.h"
#include "repair/leaks/find_leaks.h"
#include "repair/leaks/find_passes.h"
#include "unit/repair/placed_scene.h"
#include "unit/repair/random_soups.h"

#include <algorithm>
#include <atomic>

namespace transillum {
namespace {

using testing_support::PlacedScene;

std::vector<glm::dvec3> random_path(std::size_t points, double size, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0.0, size);
    std::vector<glm::dvec3> path(points);
    for (glm::dvec3& p : path) p = {coordinate(random), coordinate(random), coordinate(random)};
    return path;
}

TEST(FindPasses, FindsTheClosestOfAllSegments) {
    for (const std::size_t points : {2u, 9u, 10u, 100u}) {
        const TriangleSoup soup = testing_support::grid_soup(80, 16, 1);
        const std::vector<SideGraph::BorderEdge> border = SideGraph(soup).border();
        const std::vector<glm::dvec3> path = random_path(points, 4.0, 2);
        const Workers workers(2);
        const std::vector<Pass> passes = find_passes(soup, border, path, workers);
        ASSERT_EQ(passes.size(), border.size());
        EXPECT_TRUE(std::ranges::is_sorted(passes, {}, &Pass::distance));
        for (const Pass& pass : passes) {
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i + 1 < path.size(); ++i)
                nearest = std::min(nearest, find_passes(soup, {border[pass.edge]},
                                                        std::span(path).subspan(i, 2), workers)
                                                .front()
                                                .distance);
            EXPECT_EQ(pass.distance, nearest);
        }
    }
}

/// Two half-planes of many triangles, with a slit along the y axis between them.
TriangleSoup slit_of(double width) {
    constexpr int n = 48;
    PlacedScene made(testing_support::placements[0]);
    for (const double from : {-6.0, width})
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const double x = from + i * 0.125, y = j * 0.125;
                made.polygon(
                    {{x, y, 0}, {x + 0.125, y, 0}, {x + 0.125, y + 0.125, 0}, {x, y + 0.125, 0}});
            }
    return make_soup(made.scene);
}

// Below the limit it is looked for near by, else among all triangles.
TEST(NarrowestGap, IsTheSlitOnWhicheverSideOfTheLimit) {
    for (const double width : {0x1p-8, 0x1p-2, 1.0}) {
        const TriangleSoup soup = slit_of(width);
        const TriangleTree tree(soup);
        const std::vector<SideGraph::BorderEdge> border = SideGraph(soup).border();
        const glm::dvec3 above(0.25 * width, 3.03, 1.0), below(0.25 * width, 3.03, -1.0);
        for (const double limit : {2.0 * width, 0.5 * width, 0.0}) {
            const Gap gap =
                narrowest_gap(soup, tree, border, {{above, below}}, limit, 1e-13, Workers(2));
            EXPECT_NEAR(gap.width, width, 1e-15) << limit;
            EXPECT_NEAR(gap.place.z, 0.0, 1e-15);
        }
    }
}

TEST(NarrowestGap, DoesNotDependOnTheThreads) {
    const TriangleSoup soup = testing_support::grid_soup(4000, 64, 3);
    const TriangleTree tree(soup);
    const std::vector<SideGraph::BorderEdge> border = SideGraph(soup).border();
    const std::vector<glm::dvec3> path = random_path(30, 64.0, 4);
    for (const double limit : {0.0, 1e-3, 1.0}) {
        const Gap one = narrowest_gap(soup, tree, border, path, limit, 1e-13, Workers(1));
        const Gap four = narrowest_gap(soup, tree, border, path, limit, 1e-13, Workers(4));
        EXPECT_EQ(one.width, four.width);
        EXPECT_EQ(one.place, four.place);
    }
}

/// Wants to stop after it was asked so often.
class StopAfter : public Monitor {
public:
    explicit StopAfter(int most) : most_(most) {}
    [[nodiscard]] bool stop_requested() const override { return ++asked_ > most_; }
    [[nodiscard]] int asked() const { return asked_; }

private:
    int most_;
    mutable std::atomic<int> asked_ = 0;
};

TEST(FindLeaks, AsksForEverySourceWhetherToStop) {
    constexpr int lamps = 20;
    PlacedScene made(testing_support::placements[0]);
    made.box({0, 0, 0}, {32, 4, 4}, true, 0, 0, 5);
    const std::uint32_t light = made.material(1.0f);
    for (std::uint32_t i = 0; i < lamps; ++i)
        made.polygon({{i + 1, 1, 3}, {i + 1, 2, 3}, {i + 1.5, 2, 3}, {i + 1.5, 1, 3}}, light,
                     1 + i);
    const TriangleSoup soup = make_soup(made.scene);
    const auto leaks = [&](StopAfter& monitor) {
        return find_leaks(soup, made.scene, 0.1, Workers(2), monitor).size();
    };
    StopAfter never(1 << 30), at_once(0);
    EXPECT_EQ(leaks(never), lamps);
    EXPECT_GE(never.asked(), lamps);
    EXPECT_EQ(leaks(at_once), 0u);
    StopAfter before_the_last(never.asked() - 1);
    EXPECT_EQ(leaks(before_the_last), lamps - 1u);
}

}  // namespace
}  // namespace transillum
