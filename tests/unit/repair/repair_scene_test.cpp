// What a repair leaves: nothing that meets, the same surface, and what was not touched untouched.
#include "repair/repair_soup.h"
#include "support/scene_builder.h"
#include "unit/repair/random_soups.h"
#include "unit/repair/repaired.h"

#include <cmath>
#include <map>

namespace transillum {
namespace {

using testing_support::area_of;
using testing_support::expect_sound;
using testing_support::Facing;
using testing_support::grid_soup;
using testing_support::Outline;
using testing_support::repair;
using testing_support::scene_of;
using testing_support::SceneBuilder;

bool same(const Scene& a, const Scene& b) {
    if (a.polygons.size() != b.polygons.size() || a.corners.size() != b.corners.size())
        return false;
    for (std::size_t c = 0; c < a.corners.size(); ++c)
        if (a.positions[a.corners[c]] != b.positions[b.corners[c]]) return false;
    return a.uvs == b.uvs;
}

class RepairRounding : public testing::TestWithParam<Rounding> {};
INSTANTIATE_TEST_SUITE_P(To, RepairRounding,
                         testing::Values(Rounding::doubles, Rounding::floats, Rounding::dyadic));

TEST_P(RepairRounding, LeavesNothingThatMeets) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const Scene scene = scene_of(grid_soup(60, 6, seed));
        RepairOptions options;
        options.rounding = GetParam();
        const RepairedScene repaired = repair(scene, options);
        EXPECT_EQ(repaired.report.pairs_left, 0u) << seed;
        EXPECT_GT(repaired.report.faces_cut, 30u);
        expect_sound(repaired.scene);
    }
}

TEST(RepairScene, KeepsWhereTrianglesComeFrom) {
    const TriangleSoup soup = grid_soup(60, 8, 3);
    const Scene scene = scene_of(soup, 5);
    const Scene repaired = repair(scene).scene;
    ASSERT_GT(repaired.polygons.size(), 2 * scene.polygons.size());
    for (const Polygon& p : repaired.polygons) {
        const Polygon& source = scene.polygons[p.source_face];
        EXPECT_EQ(p.material, source.material);
        EXPECT_EQ(p.object, source.object);
        const glm::dvec3 normal = area_vector(soup, p.source_face);
        for (std::uint32_t c = p.first_corner; c < p.first_corner + p.corner_count; ++c) {
            const glm::dvec3 at = repaired.positions[repaired.corners[c]];
            const glm::dvec3 from = soup.positions[soup.triangles[p.source_face].vertices[0]];
            // Coordinates below 8 are rounded by 2^-51 at most, three times.
            EXPECT_NEAR(glm::dot(normal, at - from), 0.0, 8 * 0x1p-51 * glm::length(normal));
            EXPECT_NEAR(repaired.uvs[c].x, at.x / 8.0, 1e-6);
            EXPECT_NEAR(repaired.uvs[c].y, at.y / 8.0, 1e-6);
        }
    }
}

/// In general position nothing overlaps, so that all of every triangle is kept.
TEST(RepairScene, KeepsAllOfEveryTriangle) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    TriangleSoup soup;
    for (std::uint32_t i = 0; i < 40; ++i) {
        for (int k = 0; k < 3; ++k)
            soup.positions.emplace_back(coordinate(random), coordinate(random), coordinate(random));
        soup.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, i});
    }
    const Scene scene = scene_of(soup);
    const Scene repaired = repair(scene).scene;
    ASSERT_GT(repaired.polygons.size(), 1000u);
    expect_sound(repaired);
    std::vector<double> area(scene.polygons.size());
    const TriangleSoup parts = make_soup(repaired);
    for (std::uint32_t t = 0; t < parts.triangles.size(); ++t)
        area[repaired.polygons[parts.triangles[t].polygon].source_face] +=
            glm::length(area_vector(parts, t));
    for (std::uint32_t t = 0; t < 40; ++t)
        EXPECT_NEAR(area[t] / glm::length(area_vector(soup, t)), 1.0, 1e-12);
}

/// Neighbours have to be cut alike along their edge: not a single border may come of it.
TEST(RepairScene, KeepsClosedSurfacesClosed) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    for (int round = 0; round < 8; ++round) {
        SceneBuilder b;
        for (int i = 0; i < 6; ++i) {
            const std::size_t first = b.scene.positions.size();
            if (round % 2 == 1 || i % 2 == 0)
                b.box({0, 0, 0}, {1, 1, 1}, Facing::outwards);
            else
                b.sphere({0, 0, 0}, 0.7, 14, Facing::outwards);
            const double c = std::cos(3.0 * number(random)), s = std::sqrt(1.0 - c * c);
            const glm::dvec3 by(number(random), number(random), number(random));
            // Turned in two planes by an angle that is no fraction; or only moved, so that faces
            // of boxes overlap.
            for (std::size_t v = first; v < b.scene.positions.size(); ++v) {
                glm::dvec3& p = b.scene.positions[v];
                if (round % 2 == 0) {
                    p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
                    p = {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
                    p += by;
                } else {
                    p += glm::dvec3(i % 3 == 2 ? 0.5 : 0.0, i == 4 ? by.y : 0.0, by.z);
                }
            }
        }
        const RepairedScene repaired = repair(b.scene);
        expect_sound(repaired.scene);
        EXPECT_GT(repaired.report.faces_cut, 50u);
        EXPECT_EQ(repaired.report.pairs_left, 0u);
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces;
        const TriangleSoup soup = make_soup(repaired.scene);
        for (const SoupTriangle& t : soup.triangles)
            for (int i = 0; i < 3; ++i)
                ++faces[std::minmax(t.vertices[i], t.vertices[(i + 1) % 3])];
        for (const auto& [edge, count] : faces) ASSERT_GT(count, 1) << "round " << round;
    }
}

TEST(RepairScene, CountsOverlapsOnce) {
    SceneBuilder b;  // two squares that share a quarter, and a third on a wall
    b.polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
    b.polygon({{1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}});
    b.polygon({{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}});  // the first, wound the other way
    b.polygon({{5, 0, 0}, {5, 1, 0}, {5, 1, 1}, {5, 0, 1}});
    const RepairedScene repaired = repair(b.scene);
    expect_sound(repaired.scene);
    EXPECT_EQ(area_of(repaired.scene), 4.0 + 4.0 - 1.0 + 1.0);
    EXPECT_GE(repaired.report.coplanar_pairs, 1u);
}

/// No doubles are in a plane that is turned; what overlaps but for that, and for noise within the
/// tolerance, is to be counted once too.
TEST(RepairScene, CountsOverlapsOnceInAnyPlane) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int round = 0; round < 40; ++round) {
        const double noise = round % 2 ? 1e-8 : 0.0;
        const glm::dvec3 z =
            glm::normalize(glm::dvec3(number(random), number(random), number(random) + 1.5));
        const glm::dvec3 x = glm::normalize(glm::cross(z, glm::dvec3(0.3, 1.0, -0.2)));
        const glm::dvec3 y = glm::cross(z, x);
        SceneBuilder b;
        const auto square = [&](double u, double v, double w) {
            Outline o;
            for (const glm::dvec2 c :
                 {glm::dvec2(0, 0), glm::dvec2(w, 0), glm::dvec2(w, w), glm::dvec2(0, w)})
                o.push_back((u + c.x) * x + (v + c.y) * y + noise * number(random) * z);
            b.polygon(o);
        };
        square(0, 0, 2);
        square(1, 1, 2);
        square(1.25, 0.5, 0.5);
        square(-1, 0.75, 1.5);
        b.polygon({0.5 * x + 0.5 * y - z, 0.5 * x + 2.5 * y - z, 0.5 * x + 2.5 * y + z,
                   0.5 * x + 0.5 * y + z});  // through the first and last
        const RepairedScene repaired = repair(b.scene);
        expect_sound(repaired.scene);
        EXPECT_EQ(repaired.report.pairs_left, 0u);
        EXPECT_LE(repaired.report.largest_move, 4e-7 * diagonal_of(make_soup(b.scene)));
        // 4 + 4 - 1, and what the last has beside the first: 1.5 x 1.5 - 0.5 x 1.25; the wall: 4.
        // Moves of 3e-7, where rounding takes them, change it by as much a length of border.
        EXPECT_NEAR(area_of(repaired.scene), 7.0 + 1.625 + 4.0, 1e-6) << round;
    }
}

/// A stack that a wall cuts, on a grid far coarser than its steps: one cut brings so many more
/// pairs that the search for them ends early.
TEST(RepairScene, CountsAllPairsThatAreLeft) {
    SceneBuilder b;
    b.polygon({{0, -4, -1}, {0, 4, -1}, {0, 0, 4}});
    const int steps = 600;
    for (int i = 0; i < steps; ++i) {
        const double z = 0x1p-12 * (i + 1) / steps, turn = i;
        Outline outline;
        for (const double angle : {turn, turn + 2.0, turn + 4.0})
            outline.emplace_back(std::cos(angle), std::sin(angle), z);
        b.polygon(outline);
    }
    TriangleSoup soup = make_soup(b.scene);
    const Workers workers(2);
    const std::size_t before = find_intersections(soup, workers).size();
    RepairOptions options;
    options.close_cracks = false;
    options.rounding = Rounding::dyadic;
    options.rounds = 1;
    RepairReport report;
    Monitor silent;
    repair_soup(soup, b.scene, options, {-3, 0.0}, workers, silent, report);
    EXPECT_GT(report.pairs_left, 8 * before + 1000);
    EXPECT_EQ(report.pairs_left, find_intersections(soup, workers).size());
}

TEST(RepairScene, LeavesSoundScenesAsTheyAre) {
    SceneBuilder b;
    b.box({-0.0, 0, 0}, {1, 1, 1}, Facing::outwards);
    b.sphere({3, 3, 3}, 1.0, 16, Facing::outwards);
    for (const Rounding rounding : {Rounding::doubles, Rounding::dyadic}) {
        RepairOptions options;
        options.rounding = rounding;
        const RepairedScene repaired = repair(b.scene, options);
        for (const RepairStep& step : repaired.report.steps) ADD_FAILURE() << step.what;
        EXPECT_TRUE(repaired.report.left.empty());
        if (rounding == Rounding::doubles) {
            EXPECT_TRUE(same(repaired.scene, b.scene));
        }
    }
}

TEST(RepairScene, DoesNotTouchWhatIsSound) {
    SceneBuilder b;
    b.sphere({3, 3, 3}, 1.0 / 3.0, 16, Facing::outwards);
    const std::size_t sound = b.scene.polygons.size();
    b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    b.polygon({{0.3, 0.3, -1}, {0.7, 0.3, -1}, {0.7, 0.3, 1}, {0.3, 0.3, 1}});
    const Scene repaired = repair(b.scene).scene;
    ASSERT_GT(repaired.polygons.size(), sound + 2);
    for (std::size_t p = 0; p < sound; ++p) {
        const Polygon &was = b.scene.polygons[p], &is = repaired.polygons[p];
        ASSERT_EQ(was.corner_count, is.corner_count);
        for (std::uint32_t c = 0; c < was.corner_count; ++c)
            EXPECT_EQ(b.scene.positions[b.scene.corners[was.first_corner + c]],
                      repaired.positions[repaired.corners[is.first_corner + c]]);
    }
}

TEST(RepairScene, IsDoneAfterOneGo) {
    const Scene once = repair(scene_of(grid_soup(60, 7, 11))).scene;
    const RepairedScene twice = repair(once);
    EXPECT_FALSE(twice.report.changed());
    EXPECT_TRUE(same(once, twice.scene));
}

TEST(RepairScene, DoesNotDependOnThreads) {
    const Scene scene = scene_of(grid_soup(80, 9, 12));
    EXPECT_TRUE(same(repair(scene, {}, 1).scene, repair(scene, {}, 2).scene));
}

/// Powers of two change no digit.
TEST(RepairScene, ScalesExactly) {
    const Scene scene = scene_of(grid_soup(60, 9, 13));
    const Scene repaired = repair(scene).scene;
    for (const double scale : {0x1p-40, 0x1p40}) {
        Scene scaled = scene;
        for (glm::dvec3& p : scaled.positions) p *= scale;
        Scene result = repair(scaled).scene;
        for (glm::dvec3& p : result.positions) p /= scale;
        ASSERT_EQ(result.corners.size(), repaired.corners.size());
        for (std::size_t c = 0; c < result.corners.size(); ++c)
            ASSERT_EQ(result.positions[result.corners[c]], repaired.positions[repaired.corners[c]]);
    }
}

TEST(RepairScene, ClosesCracks) {
    SceneBuilder b;  // a square beside two of half its size, whose common corner is beside its edge
    const double off = 1e-7;
    b.polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
    b.polygon({{2 + off, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2 + off, 1, off}});
    b.polygon({{2 + off, 1, off}, {3, 1, 0}, {3, 2, 0}, {2 + off, 2, 0}});
    const TriangleSoup before = make_soup(b.scene);
    const double tolerance = 4e-7 * diagonal_of(before);
    EXPECT_FALSE(find_t_junctions(before, tolerance).empty());
    const RepairedScene repaired = repair(b.scene);
    const TriangleSoup after = make_soup(repaired.scene);
    EXPECT_TRUE(find_t_junctions(after, tolerance).empty());
    const std::vector<std::uint32_t> near = find_near_vertices(after, tolerance);
    for (std::uint32_t v = 0; v < near.size(); ++v) EXPECT_EQ(near[v], v);
    EXPECT_LE(repaired.report.largest_move, tolerance);
    expect_sound(repaired.scene);
}

TEST(RepairScene, MovesAndCutsNothingWhereSafe) {
    const Scene scene = scene_of(grid_soup(60, 6, 4));
    RepairOptions options;
    options.level = RepairLevel::safe;
    const RepairedScene repaired = repair(scene, options);
    EXPECT_EQ(repaired.report.faces_cut, 0u);
    EXPECT_EQ(repaired.scene.polygons.size(), scene.polygons.size());
    options.level = RepairLevel::off;
    EXPECT_TRUE(same(repair(scene, options).scene, scene));
}

}  // namespace
}  // namespace transillum
