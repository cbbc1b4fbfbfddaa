#include "support/scene_builder.h"

#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/subdivide_scene.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <map>

namespace transillum {
namespace {

using testing_support::Facing;
using testing_support::Recorder;
using testing_support::SceneBuilder;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

std::array<glm::dvec3, 3> corners_of(const Scene& scene, std::size_t polygon) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = scene.positions[scene.corners[scene.polygons[polygon].first_corner + i]];
    return corners;
}

/// Twice the area vector.
Exact::Vector_3 exact_area(const std::array<glm::dvec3, 3>& p) {
    const auto point = [](const glm::dvec3& v) { return Exact::Point_3(v.x, v.y, v.z); };
    return CGAL::cross_product(point(p[1]) - point(p[0]), point(p[2]) - point(p[0]));
}

double longest_edge(const Scene& scene) {
    double longest = 0.0;
    for (std::size_t t = 0; t < scene.polygons.size(); ++t) {
        const auto p = corners_of(scene, t);
        for (std::size_t i = 0; i < 3; ++i)
            longest = std::max(longest, glm::length(p[i] - p[(i + 1) % 3]));
    }
    return longest;
}

/// Every edge of a closed surface has as many faces one way as the other: a T-junction would leave
/// some without.
void expect_closed(const Scene& scene) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces;
    for (const Polygon& p : scene.polygons)
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t a = scene.corners[p.first_corner + i],
                                b = scene.corners[p.first_corner + (i + 1) % 3];
            faces[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    std::size_t open = 0;
    for (const auto& [edge, sum] : faces) open += sum != 0;
    EXPECT_EQ(open, 0u);
}

/// Closed, of needles and of large faces beside small ones.
Scene uneven_solid() {
    SceneBuilder b;
    const glm::dvec3 top(0.1, 0.2, 7.3), middle(0.03, 0.02, 0.0);
    std::vector<glm::dvec3> ring;
    for (int i = 0; i < 11; ++i)
        ring.push_back({std::cos(0.05 * i * i), std::sin(0.05 * i * i), 0.1 * (i % 3)});
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec3 &p = ring[i], &q = ring[(i + 1) % ring.size()];
        b.polygon({p, q, top});
        b.polygon({q, p, middle});
    }
    return b.scene;
}

Scene subdivided(const Scene& scene, const SceneSubdivision& options,
                 SubdivisionReport* report = nullptr) {
    Monitor silent;
    return subdivide_scene(scene, options, silent, report);
}

/// The scene's own triangles on the grid.
Scene snapped(const Scene& scene) {
    return subdivided(scene, {.level = 0});
}

TEST(SubdivideScene, KeepsToTheLongestEdgeWithoutTJunctions) {
    const Scene solid = uneven_solid();
    expect_closed(snapped(solid));
    for (const double edge : {8.0, 3.0, 1.0, 0.5, 0.2, 0.07}) {
        SubdivisionReport report;
        const Scene fine = subdivided(solid, {.max_edge = edge}, &report);
        EXPECT_LE(longest_edge(fine), edge);
        EXPECT_EQ(report.triangles, fine.polygons.size());
        EXPECT_LE(report.deepest, max_subdivision_level);
        expect_closed(fine);
    }
}

TEST(SubdivideScene, KeepsAreaExactly) {
    const Scene solid = uneven_solid();
    const Scene coarse = snapped(solid);
    for (const SceneSubdivision& options :
         {SceneSubdivision{.max_edge = 0.3}, SceneSubdivision{.level = 3}}) {
        const Scene fine = subdivided(solid, options);
        std::map<std::uint32_t, Exact::Vector_3> sums;
        for (std::size_t t = 0; t < fine.polygons.size(); ++t) {
            const auto [sum, is_new] =
                sums.try_emplace(fine.polygons[t].source_face, CGAL::NULL_VECTOR);
            sum->second = sum->second + exact_area(corners_of(fine, t));
        }
        ASSERT_EQ(sums.size(), coarse.polygons.size());
        for (std::size_t t = 0; t < coarse.polygons.size(); ++t)
            EXPECT_TRUE(sums.at(coarse.polygons[t].source_face) ==
                        exact_area(corners_of(coarse, t)));
    }
}

TEST(SubdivideScene, OfALevelIsOneToFour) {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 2, 3}, Facing::outwards);
    for (const int level : {0, 1, 4}) {
        const Scene fine = subdivided(b.scene, {.level = level});
        EXPECT_EQ(fine.polygons.size(), 12u << (2 * level));
        expect_closed(fine);
        EXPECT_NEAR(longest_edge(fine) * (1 << level), std::sqrt(13.0), 1e-12);
    }
}

/// u = x / 4 and v = y / 2 hold everywhere, for both are linear and exact.
TEST(SubdivideScene, KeepsWhereTrianglesComeFrom) {
    SceneBuilder b;
    b.scene.objects = {"a", "b"};
    const std::uint32_t red = b.material(Spectrum(0.3f));
    b.polygon({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}}, 0, 0);
    b.polygon({{0, 0, 1}, {1, 0, 1}, {0, 2, 1}}, red, 1);
    for (const std::uint32_t c : b.scene.corners)
        b.scene.uvs.emplace_back(b.scene.positions[c].x / 4.0, b.scene.positions[c].y / 2.0);
    b.scene.cameras.resize(2);
    const Scene fine = subdivided(b.scene, {.max_edge = 0.3});
    EXPECT_EQ(fine.cameras.size(), 2u);
    ASSERT_EQ(fine.uvs.size(), fine.corners.size());
    for (std::size_t c = 0; c < fine.corners.size(); ++c) {
        const glm::dvec3& p = fine.positions[fine.corners[c]];
        EXPECT_EQ(fine.uvs[c], glm::vec2(p.x / 4.0, p.y / 2.0));
    }
    for (std::size_t t = 0; t < fine.polygons.size(); ++t) {
        const bool second = corners_of(fine, t)[0].z == 1.0;
        EXPECT_EQ(fine.polygons[t].material, second ? red : 0u);
        EXPECT_EQ(fine.polygons[t].object, second ? 1u : 0u);
        EXPECT_EQ(fine.polygons[t].source_face, second ? 1u : 0u);
    }
}

TEST(SubdivideScene, SaysHowFarItMovedVertices) {
    SceneBuilder b;
    b.polygon({{0.1, 0, 0}, {1e6, 1.0 / 3.0, 0}, {0, 1e6, 0.7}});
    Recorder recorder;
    SubdivisionReport report;
    (void)subdivide_scene(b.scene, {.level = 1}, recorder, &report);
    EXPECT_EQ(report.grid.exponent, -20);
    EXPECT_GT(report.grid.largest_move, 0.0);
    EXPECT_LE(report.grid.largest_move, std::sqrt(3.0) * 0x1p-21);
    EXPECT_THAT(recorder.notes, testing::Contains(testing::HasSubstr("grid of 9.53674e-07")));
}

TEST(SubdivideScene, RefusesWhatItCannotMeet) {
    SceneBuilder b;
    b.box({0, 0, 0}, {1, 1, 1}, Facing::outwards);
    for (const SceneSubdivision& options :
         {SceneSubdivision{}, SceneSubdivision{.max_edge = 1.0, .level = 1},
          SceneSubdivision{.max_edge = -1.0}, SceneSubdivision{.max_edge = NAN},
          SceneSubdivision{.max_edge = 1e-3}, SceneSubdivision{.max_edge = 1.3e-3},
          SceneSubdivision{.level = max_subdivision_level + 1}, SceneSubdivision{.level = -2}})
        EXPECT_THROW((void)subdivided(b.scene, options), UsageError);
    try {
        (void)subdivided(b.scene, {.level = max_subdivision_level});
        ADD_FAILURE();
    } catch (const UsageError& error) {
        EXPECT_STREQ(error.what(),
                     "subdivision into 50331648 triangles; accepted: at most "
                     "16777216; lower the level");
    }
}

/// In a strip, random lengths of each share of a level with their neighbours.
TEST(SubdivideScene, StaysWithinTheLevelsThatAreExact) {
    Random random(4, 4);
    for (int trial = 0; trial < 200; ++trial) {
        SceneBuilder b;
        const auto point = [&] {
            const double x = random.next(), y = random.next() * std::pow(0.1, trial % 5);
            return glm::dvec3(x, y, random.next() * std::pow(0.1, trial % 3));
        };
        const glm::dvec3 p = point(), q = point();
        b.polygon({p, q, point()});
        const Scene coarse = snapped(b.scene);
        SubdivisionReport report;
        const double edge = longest_edge(coarse) * (0.02 + 0.3 * random.next());
        const Scene fine = subdivided(b.scene, {.max_edge = edge}, &report);
        EXPECT_LE(longest_edge(fine), edge);
        // Two more than halving the longest edge takes: the diagonals of quadrilaterals.
        EXPECT_LE(report.deepest, std::ceil(std::log2(longest_edge(coarse) / edge)) + 2.0);
        Exact::Vector_3 sum(0, 0, 0);
        for (std::size_t t = 0; t < fine.polygons.size(); ++t)
            sum = sum + exact_area(corners_of(fine, t));
        EXPECT_TRUE(sum == exact_area(corners_of(coarse, 0)));
    }
}

}  // namespace
}  // namespace transillum
