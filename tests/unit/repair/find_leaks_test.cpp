#include <transillum/repair/check_scene.h>

#include "repair/leaks/find_leaks.h"
#include "repair/leaks/side_graph.h"
#include "unit/repair/placed_scene.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <set>

namespace transillum {
namespace {

using testing_support::Placed;
using testing_support::PlacedScene;

CheckReport check(const Scene& scene, double leak_width = 0.01) {
    Monitor silent;
    CheckOptions options;
    options.leak_width = leak_width;
    return check_scene(scene, options, Workers(2), silent);
}

/// The wall y = 0 of a room with corners (0 0 0) and (4 4 4), with a hole.
void add_wall_with_hole(PlacedScene& made, const glm::dvec2& low, const glm::dvec2& high) {
    const std::array<double, 4> xs{0, low.x, high.x, 4}, zs{0, low.y, high.y, 4};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (i != 1 || j != 1)
                made.polygon({{xs[i], 0, zs[j]},
                              {xs[i], 0, zs[j + 1]},
                              {xs[i + 1], 0, zs[j + 1]},
                              {xs[i + 1], 0, zs[j]}});
}

constexpr int low_y = 2;  // of PlacedScene::box

class Leaks : public Placed {
protected:
    /// A square that shines downwards, in the middle of the room.
    void add_lamp() {
        const std::uint32_t light = made.material(1.0f);
        made.polygon({{1.75, 1.75, 3}, {1.75, 2.25, 3}, {2.25, 2.25, 3}, {2.25, 1.75, 3}}, light,
                     1);
    }

    /// From the luminaire to outside, through no surface.
    void expect_way(const Leak& leak, const Scene& scene) {
        EXPECT_EQ(leak.from, "luminaire 'object 1'");
        ASSERT_GE(leak.path.size(), 2u);
        double length = 0.0;
        for (std::size_t i = 1; i < leak.path.size(); ++i)
            length += glm::length(leak.path[i] - leak.path[i - 1]);
        EXPECT_NEAR(leak.length, length, 1e-12 * length);
        const glm::dvec3 end = leak.path.back();
        EXPECT_GT(glm::length(end - made.place({2, 2, 2})), 2.0 * GetParam().scale);
        const TriangleSoup soup = make_soup(scene);
        for (std::size_t i = 1; i < leak.path.size(); ++i)
            expect_free(soup, leak.path[i - 1], leak.path[i]);
    }

    /// Passes through no triangle's inside: what it touches, it touches at an end.
    static void expect_free(const TriangleSoup& soup, const glm::dvec3& a, const glm::dvec3& b) {
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            const auto& v = soup.triangles[t].vertices;
            const glm::dvec3 n = area_vector(soup, t);
            const double at_a = glm::dot(n, a - soup.positions[v[0]]);
            const double at_b = glm::dot(n, b - soup.positions[v[0]]);
            const double tiny = 1e-9 * glm::length(n) * glm::length(b - a);
            if (!((at_a > tiny && at_b < -tiny) || (at_a < -tiny && at_b > tiny))) continue;
            const glm::dvec3 met = a + (b - a) * (at_a / (at_a - at_b));
            bool inside = true;
            for (int c = 0; c < 3; ++c) {
                const glm::dvec3& from = soup.positions[v[c]];
                const glm::dvec3 along = soup.positions[v[(c + 1) % 3]] - from;
                inside &= glm::dot(glm::cross(along, met - from), n) > 1e-9 * glm::dot(n, n);
            }
            EXPECT_FALSE(inside) << "triangle " << t;
        }
    }
};

TEST_P(Leaks, AreNotInAClosedRoom) {
    made.box({0, 0, 0}, {4, 4, 4}, true);
    add_lamp();
    const CheckReport report = check(made.scene);
    EXPECT_TRUE(report.leaks_searched);
    EXPECT_TRUE(report.leaks.empty());
}

TEST_P(Leaks, AreNotSoughtWithoutLuminaireAndCamera) {
    made.box({0, 0, 0}, {4, 4, 4}, true, 0, 0, low_y);
    EXPECT_FALSE(check(made.scene).leaks_searched);
}

TEST_P(Leaks, AreOpeningsWhereAWholeSideIsMissing) {
    made.box({0, 0, 0}, {4, 4, 4}, true, 0, 0, low_y);
    add_lamp();
    const CheckReport report = check(made.scene);
    ASSERT_EQ(report.leaks.size(), 1u);
    EXPECT_TRUE(report.leaks[0].is_opening);
    EXPECT_EQ(report.counts[std::size_t(Defect::leak)], 0u);
    expect_way(report.leaks[0], made.scene);
}

TEST_P(Leaks, AreAsWideAsTheHole) {
    for (const double width : {0x1p-4, 0x1p-8, 0x1p-20}) {
        made = PlacedScene(GetParam());
        made.box({0, 0, 0}, {4, 4, 4}, true, 0, 0, low_y);
        add_wall_with_hole(made, {0.5, 1}, {0.5 + width, 2});
        add_lamp();
        const CheckReport report = check(made.scene);
        ASSERT_EQ(report.leaks.size(), 1u) << width;
        const Leak& leak = report.leaks[0];
        EXPECT_NEAR(leak.width, width * GetParam().scale, 1e-6 * width * GetParam().scale);
        EXPECT_EQ(leak.is_opening, leak.width > 0.01 * report.diagonal);
        EXPECT_EQ(report.counts[std::size_t(Defect::leak)], leak.is_opening ? 0u : 1u);
        expect_way(leak, made.scene);
    }
}

// However few straight ways are tried of how many.
TEST_P(Leaks, AreFoundWhereOneOfManySquaresIsMissing) {
    constexpr int n = 32;
    constexpr double size = 4.0 / n;
    for (const bool inwards : {false, true}) {
        made = PlacedScene(GetParam());
        for (int axis = 0; axis < 3; ++axis)
            for (const bool high : {false, true})
                for (int i = 0; i < n; ++i)
                    for (int j = 0; j < n; ++j) {
                        if (axis == 1 && high && i == 5 && j == 20) continue;
                        std::vector<glm::dvec3> outline(4, glm::dvec3(high ? 4 : 0));
                        for (int c = 0; c < 4; ++c) {
                            outline[c][(axis + 1) % 3] = size * (i + (c == 1 || c == 2 ? 1 : 0));
                            outline[c][(axis + 2) % 3] = size * (j + (c >= 2 ? 1 : 0));
                        }
                        if (high == inwards) std::ranges::reverse(outline);
                        made.polygon(outline);
                    }
        add_lamp();
        const CheckReport report = check(made.scene, 0.05);
        ASSERT_EQ(report.leaks.size(), 1u);
        EXPECT_NEAR(report.leaks[0].width, size * GetParam().scale, 1e-6 * GetParam().scale);
        EXPECT_FALSE(report.leaks[0].is_opening);
        expect_way(report.leaks[0], made.scene);
    }
}

TEST_P(Leaks, AreFoundUnderALidThatLiesOpenByAHair) {
    constexpr double slit = 0x1p-30;      // 1e-9
    constexpr double rounding = 0x1p-38;  // a few units in the last place, far away
    made.box({0, 0, 0}, {4, 4, 4}, true, 0, 0, 1);
    made.polygon({{-1, -1, 4 + slit}, {5, -1, 4 + slit}, {5, 5, 4 + slit}, {-1, 5, 4 + slit}});
    add_lamp();
    const CheckReport report = check(made.scene);
    ASSERT_EQ(report.leaks.size(), 1u);
    EXPECT_FALSE(report.leaks[0].is_opening);
    EXPECT_NEAR(report.leaks[0].width, slit * GetParam().scale, rounding * GetParam().scale);
    EXPECT_EQ(report.counts[std::size_t(Defect::leak)], 1u);
}

/// The lid ends straight above the flange's edge.
TEST_P(Leaks, AreFoundBetweenALidAndAFlangeThatAreFlush) {
    for (const double slit : {0x1p-8, 0x1p-16}) {
        made = PlacedScene(GetParam());
        made.box({0, 0, 0}, {4, 4, 4}, true, 0, 0, 1);
        made.polygon({{0, 0, 4}, {4, 0, 4}, {5, -1, 4}, {-1, -1, 4}});
        made.polygon({{4, 0, 4}, {4, 4, 4}, {5, 5, 4}, {5, -1, 4}});
        made.polygon({{4, 4, 4}, {0, 4, 4}, {-1, 5, 4}, {5, 5, 4}});
        made.polygon({{0, 4, 4}, {0, 0, 4}, {-1, -1, 4}, {-1, 5, 4}});
        made.polygon({{-1, -1, 4 + slit}, {5, -1, 4 + slit}, {5, 5, 4 + slit}, {-1, 5, 4 + slit}});
        add_lamp();
        const CheckReport report = check(made.scene);
        ASSERT_EQ(report.leaks.size(), 1u);
        EXPECT_FALSE(report.leaks[0].is_opening);
        EXPECT_NEAR(report.leaks[0].width / GetParam().scale, slit, 0x1p-36);
    }
}

TEST_P(Leaks, AreNotUnderALidThatLiesOnTheRim) {
    made.box({0, 0, 0}, {4, 4, 4}, true, 0, 0, 1);
    made.polygon({{-1, -1, 4}, {5, -1, 4}, {5, 5, 4}, {-1, 5, 4}});
    add_lamp();
    EXPECT_TRUE(check(made.scene).leaks.empty());
}

TEST_P(Leaks, AreNotAtVerticesThatLieOnEdges) {
    // The wall y = 0 in two halves, whose middle no other side knows of.
    made.box({0, 0, 0}, {4, 4, 4}, true, 0, 0, low_y);
    made.polygon({{0, 0, 0}, {0, 0, 4}, {2, 0, 4}, {2, 0, 0}});
    made.polygon({{2, 0, 0}, {2, 0, 4}, {4, 0, 4}, {4, 0, 0}});
    add_lamp();
    EXPECT_TRUE(check(made.scene).leaks.empty());
}

TEST_P(Leaks, AreNotWhereWallsPassThroughEachOther) {
    // No wall ends where another begins.
    made.polygon({{-1, -1, 0}, {5, -1, 0}, {5, 5, 0}, {-1, 5, 0}});
    made.polygon({{-1, -1, 4}, {-1, 5, 4}, {5, 5, 4}, {5, -1, 4}});
    made.polygon({{-2, 0, -1}, {-2, 0, 5}, {6, 0, 5}, {6, 0, -1}});
    made.polygon({{-2, 4, -1}, {6, 4, -1}, {6, 4, 5}, {-2, 4, 5}});
    made.polygon({{0, -0.5, -0.5}, {0, 4.5, -0.5}, {0, 4.5, 4.5}, {0, -0.5, 4.5}});
    made.polygon({{4, -0.5, -0.5}, {4, -0.5, 4.5}, {4, 4.5, 4.5}, {4, 4.5, -0.5}});
    add_lamp();
    EXPECT_TRUE(check(made.scene).leaks.empty());
}

TEST_P(Leaks, LeadThroughTheHolesOfBoxesInBoxes) {
    made.box({0, 0, 0}, {4, 4, 4}, true, 0, 0, low_y);
    add_wall_with_hole(made, {3, 3}, {3 + 0x1p-6, 3.5});
    made.box({1, 1, 1}, {3.5, 3, 3.5}, true, 0, 0, 5);
    // The side x = 3.5 has a slit of its own, less wide.
    made.polygon({{3.5, 1, 1}, {3.5, 1, 3.5}, {3.5, 2, 3.5}, {3.5, 2, 1}});
    made.polygon({{3.5, 2 + 0x1p-8, 1}, {3.5, 2 + 0x1p-8, 3.5}, {3.5, 3, 3.5}, {3.5, 3, 1}});
    add_lamp();
    const CheckReport report = check(made.scene);
    ASSERT_EQ(report.leaks.size(), 1u);
    const double width = 0x1p-8 * GetParam().scale;
    EXPECT_NEAR(report.leaks[0].width, width, 1e-6 * width);
    EXPECT_FALSE(report.leaks[0].is_opening);
    expect_way(report.leaks[0], made.scene);
    // Either hole closed, there is none.
    PlacedScene closed(GetParam());
    std::swap(made, closed);
    made.box({0, 0, 0}, {4, 4, 4}, true);
    made.box({1, 1, 1}, {3.5, 3, 3.5}, true, 0, 0, 5);
    add_lamp();
    EXPECT_TRUE(check(made.scene).leaks.empty());
}

TEST_P(Leaks, AreOpeningsWhereThereIsAWideWayToo) {
    made.box({0, 0, 0}, {4, 4, 4}, true, 0, 0, low_y);
    add_wall_with_hole(made, {1, 2.75}, {1 + 0x1p-8, 3.25});
    made.scene.polygons.erase(made.scene.polygons.begin() + 4);  // x = 4 - or x = 0 - is open
    add_lamp();
    const CheckReport report = check(made.scene);
    ASSERT_EQ(report.leaks.size(), 1u);
    EXPECT_TRUE(report.leaks[0].is_opening);
}

TEST_P(Leaks, AreFoundFromLightsAndCameras) {
    made.box({0, 0, 0}, {4, 4, 4}, true, 0, 0, low_y);
    add_wall_with_hole(made, {0.5, 1}, {0.5 + 0x1p-8, 2});
    made.scene.lighting.lights.emplace_back().name = "bulb";
    made.scene.lighting.lights.back().position = made.place({2, 2, 1});
    Camera camera;
    camera.name = "front";
    camera.eye = made.place({1, 1, 1});
    camera.look_at = made.place({3, 2.5, 1.25});
    made.scene.cameras.push_back(camera);
    const CheckReport report = check(made.scene);
    ASSERT_EQ(report.leaks.size(), 2u);
    EXPECT_EQ(report.leaks[0].from, "light 'bulb'");
    EXPECT_EQ(report.leaks[0].path.front(), made.place({2, 2, 1}));
    EXPECT_EQ(report.leaks[1].from, "camera 'front'");
    EXPECT_EQ(report.leaks[1].path.front(), camera.eye);
    for (const Leak& leak : report.leaks)
        EXPECT_NEAR(leak.width, 0x1p-8 * GetParam().scale, 1e-8 * GetParam().scale);
}

TRANSILLUM_AT_ALL_PLACES(Leaks);

TEST(SideGraphs, JoinSidesInTheOrderAroundAnEdge) {
    // Five faces on one edge, in an order that is not that of their directions; fronts either way.
    PlacedScene made(testing_support::placements[0]);
    const std::array<glm::dvec2, 5> tips{{{1, 0}, {-1, 2}, {0, -1}, {-1, 0}, {3, 1}}};
    const std::array<int, 5> around{0, 4, 1, 3, 2};  // counter-clockwise about z
    const std::set<int> turned{1, 2};
    for (int i = 0; i < 5; ++i) {
        const glm::dvec3 tip(tips[i], 0.5);
        if (turned.contains(i))
            made.polygon({{0, 0, 1}, {0, 0, 0}, tip});
        else
            made.polygon({{0, 0, 0}, {0, 0, 1}, tip});
    }
    const TriangleSoup soup = make_soup(made.scene);
    const SideGraph graph(soup);
    for (int i = 0; i < 5; ++i) {
        const int face = around[i], next = around[(i + 1) % 5];
        // A face that runs upwards has its front ahead.
        const Side ahead = 2 * face + (turned.contains(face) ? 1 : 0);
        const Side behind = 2 * next + (turned.contains(next) ? 0 : 1);
        EXPECT_EQ(graph.across(ahead, 0), behind) << face;
        EXPECT_EQ(graph.across(behind, 0), ahead) << face;
    }
    EXPECT_EQ(graph.border().size(), 10u);
}

}  // namespace
}  // namespace transillum
