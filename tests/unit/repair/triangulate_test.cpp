#include "repair/triangulate.h"

#include <transillum/base/sampling.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace transillum {
namespace {

using Outline = std::vector<glm::dvec3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Corners in a plane of integer coordinates, tilted so that every sum below is exact in double.
Outline tilted(const std::vector<std::pair<int, int>>& corners) {
    Outline outline;
    for (const auto& [x, y] : corners)
        outline.push_back(glm::dvec3(2, 1, -1) * double(x) + glm::dvec3(-1, 3, 4) * double(y));
    return outline;
}
const glm::dvec3 plane_normal = glm::cross(glm::dvec3(2, 1, -1), glm::dvec3(-1, 3, 4));

/// Twice the sum of the triangles' areas in the tilted plane, each of which must be positive.
double area_in_plane(const Outline& outline, const Triangles& triangles, double sign = 1.0) {
    double sum = 0.0;
    for (const auto& t : triangles) {
        const glm::dvec3 a = outline[t[0]];
        const glm::dvec3 area = glm::cross(outline[t[1]] - a, outline[t[2]] - a);
        const double scaled =
            sign * glm::dot(area, plane_normal) / glm::dot(plane_normal, plane_normal);
        EXPECT_GT(scaled, 0.0) << "a triangle turned the other way";
        sum += scaled;
    }
    return sum;
}

/// From every starting corner and both ways round: area in grid cells, no triangle turned over.
void expect_area(const std::vector<std::pair<int, int>>& corners, double cells) {
    Outline outline = tilted(corners);
    for (const double sign : {1.0, -1.0}) {
        for (std::size_t start = 0; start < outline.size(); ++start) {
            EXPECT_EQ(area_in_plane(outline, triangulate_polygon(outline), sign), 2.0 * cells)
                << "from corner " << start << ", sign " << sign;
            std::rotate(outline.begin(), outline.begin() + 1, outline.end());
        }
        std::ranges::reverse(outline);
    }
}

TEST(TriangulatePolygon, KeepsTheAreaOfConvexAndConcaveOutlines) {
    expect_area({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 16);
    expect_area({{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 5}, {0, 5}}, 18);                  // L
    expect_area({{0, 0}, {7, 0}, {7, 5}, {5, 5}, {5, 2}, {2, 2}, {2, 5}, {0, 5}}, 26);  // U
    expect_area({{0, 6}, {-2, 2}, {-6, 0}, {-2, -2}, {0, -6}, {2, -2}, {6, 0}, {2, 2}},
                48);                                     // star
    expect_area({{0, 0}, {5, 1}, {10, 0}, {5, 9}}, 40);  // arrow head
}

TEST(TriangulatePolygon, CutsOutAWindowJoinedAtACorner) {
    // The outline passes its fifth corner again after going round the window.
    expect_area({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {2, 5}, {2, 7}, {7, 7}, {7, 3}, {4, 3}, {2, 5}},
                81 - 9 - 18);
}

TEST(TriangulatePolygon, CutsOutAWindowBehindASeam) {
    expect_area({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}},
                72);
    // Two windows, each with a seam of its own.
    expect_area({{0, 0},
                 {5, 0},
                 {5, 1},
                 {4, 1},
                 {4, 2},
                 {6, 2},
                 {6, 1},
                 {5, 1},
                 {5, 0},
                 {9, 0},
                 {9, 9},
                 {5, 9},
                 {5, 8},
                 {6, 8},
                 {6, 6},
                 {5, 6},
                 {5, 8},
                 {5, 9},
                 {0, 9}},
                81 - 2 - 2);
    // The way back along the seam has one corner more than the way in.
    expect_area(
        {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {4, 4}, {4, 6}, {6, 6}, {6, 4}, {4, 4}, {2, 2}},
        77);
}

/// Round the inner square and back again: it bounds nothing.
TEST(TriangulatePolygon, IgnoresALoopWalkedBothWays) {
    expect_area({{0, 0},
                 {9, 0},
                 {9, 9},
                 {0, 9},
                 {0, 0},
                 {3, 3},
                 {3, 6},
                 {6, 6},
                 {6, 3},
                 {3, 3},
                 {6, 3},
                 {6, 6},
                 {3, 6},
                 {3, 3}},
                81);
}

TEST(TriangulatePolygon, KeepsCornersOnStraightEdges) {
    std::vector<std::pair<int, int>> corners;
    for (int i = 0; i < 5; ++i) corners.push_back({i, 0});
    for (int i = 0; i < 5; ++i) corners.push_back({5, i});
    for (int i = 5; i > 0; --i) corners.push_back({i, 5});
    for (int i = 5; i > 0; --i) corners.push_back({0, i});
    expect_area(corners, 25);
    const Triangles triangles = triangulate_polygon(tilted(corners));
    EXPECT_EQ(triangles.size(), corners.size() - 2);
    std::set<std::uint32_t> used;
    for (const auto& t : triangles) used.insert(t.begin(), t.end());
    EXPECT_EQ(used.size(), corners.size());
}

TEST(TriangulatePolygon, TakesRepeatedCornersForOne) {
    expect_area({{0, 0}, {0, 0}, {4, 0}, {4, 4}, {4, 4}, {4, 4}, {0, 4}}, 16);
    expect_area({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}, 16);
    expect_area({{0, 0}, {4, 0}, {4, 0}, {0, 4}}, 8);
}

TEST(TriangulatePolygon, IgnoresSpikes) {
    expect_area({{0, 0}, {4, 0}, {9, 0}, {4, 0}, {4, 4}, {0, 4}}, 16);
}

TEST(TriangulatePolygon, GivesNothingWithoutArea) {
    EXPECT_TRUE(triangulate_polygon({}).empty());
    EXPECT_TRUE(triangulate_polygon(tilted({{0, 0}})).empty());
    EXPECT_TRUE(triangulate_polygon(tilted({{0, 0}, {1, 1}})).empty());
    EXPECT_TRUE(triangulate_polygon(tilted({{0, 0}, {1, 1}, {2, 2}, {5, 5}})).empty());
    EXPECT_TRUE(triangulate_polygon(tilted({{3, 1}, {3, 1}, {3, 1}, {3, 1}})).empty());
}

TEST(TriangulatePolygon, CutsAnOutlineThatCrossesItselfIntoAFan) {
    const Outline bow = tilted({{0, 0}, {4, 4}, {4, 0}, {0, 2}});
    const Triangles triangles = triangulate_polygon(bow);
    EXPECT_EQ(triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
    // A five-pointed star drawn in one stroke.
    EXPECT_EQ(triangulate_polygon(tilted({{0, 6}, {4, -6}, {-6, 2}, {6, 2}, {-4, -6}})).size(), 3u);
}

/// Outlines whose corners are seen from the middle in order of their angle are simple.
TEST(TriangulatePolygon, KeepsTheAreaOfRandomOutlines) {
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        Random random(trial, 1);
        std::map<double, std::pair<int, int>> by_angle;
        while (by_angle.size() < 3 + trial % 60) {
            const int x = static_cast<int>(2000.0 * random.next()) - 1000;
            const int y = static_cast<int>(2000.0 * random.next()) - 1000;
            if (x != 0 || y != 0) by_angle.insert({std::atan2(y, x), {x, y}});
        }
        // The middle is inside only where no gap between neighbours reaches half a turn.
        double widest = by_angle.begin()->first + 2.0 * std::numbers::pi - by_angle.rbegin()->first;
        for (auto i = std::next(by_angle.begin()); i != by_angle.end(); ++i)
            widest = std::max(widest, i->first - std::prev(i)->first);
        if (widest >= std::numbers::pi) continue;
        std::vector<std::pair<int, int>> corners;
        for (const auto& [angle, corner] : by_angle) corners.push_back(corner);
        double twice = 0.0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto [ax, ay] = corners[i];
            const auto [bx, by] = corners[(i + 1) % corners.size()];
            twice += double(ax) * by - double(bx) * ay;
        }
        const Outline outline = tilted(corners);
        const Triangles triangles = triangulate_polygon(outline);
        EXPECT_EQ(triangles.size(), corners.size() - 2);
        EXPECT_EQ(area_in_plane(outline, triangles), twice) << "trial " << trial;
    }
}

}  // namespace
}  // namespace transillum
