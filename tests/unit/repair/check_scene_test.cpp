#include <transillum/repair/check_scene.h>

#include <transillum/base/error.h>

#include "unit/repair/placed_scene.h"

#include <algorithm>
#include <map>

namespace transillum {
namespace {

using Counts = std::map<std::string, std::uint64_t>;
using testing_support::PlacedScene;

constexpr double gap = 0x1p-24;  // below the tolerance, exact beside 4096

CheckReport check(const Scene& scene, const CheckOptions& options = {}) {
    Monitor silent;
    return check_scene(scene, options, Workers(2), silent);
}

/// Those that are not zero; welded vertices are left out, as polygons here share none.
Counts counts_of(const DefectCounts& counts) {
    Counts found;
    for (std::size_t d = 1; d < defect_count; ++d)
        if (counts[d] > 0) found[std::string(name_of(static_cast<Defect>(d)))] = counts[d];
    return found;
}

class CheckScene : public testing_support::Placed {
protected:
    void expect(const Counts& expected) {
        const CheckReport report = check(made.scene);
        EXPECT_EQ(counts_of(report.counts), expected);
        Counts sites;
        for (const DefectSite& site : report.sites) ++sites[std::string(name_of(site.defect))];
        EXPECT_EQ(sites, expected);
        EXPECT_TRUE(std::ranges::is_sorted(report.sites, {}, &DefectSite::defect));
        bool harmful = false;
        for (std::size_t d = 0; d < defect_count; ++d)
            harmful |= report.counts[d] > 0 && is_harmful(static_cast<Defect>(d));
        EXPECT_EQ(report.is_sound(), !harmful);
    }
};

TEST_P(CheckScene, FindsNothingOnACube) {
    made.box({0, 0, 0}, {1, 1, 1});
    expect({});
    const CheckReport report = check(made.scene);
    EXPECT_EQ(report.polygons, 6u);
    EXPECT_EQ(report.triangles, 12u);
    EXPECT_EQ(report.vertices, 8u);
    EXPECT_EQ(report.counts[0], 16u);  // 24 corners on 8 vertices
    EXPECT_EQ(report.objects[0].counts[0], 16u);
    ASSERT_EQ(report.components.size(), 1u);
    EXPECT_TRUE(report.components[0].closed);
    EXPECT_EQ(report.components[0].volume, std::pow(GetParam().scale, 3));
    EXPECT_EQ(report.components[0].borders, 0u);
}

TEST_P(CheckScene, TellsARoomAsInsideOut) {
    made.box({0, 0, 0}, {1, 1, 1}, true);
    expect({{"inside-out", 1}});
    EXPECT_EQ(check(made.scene).components[0].volume, -std::pow(GetParam().scale, 3));
}

TEST_P(CheckScene, CountsBordersAndTheirLoops) {
    made.box({0, 0, 0}, {1, 1, 1}, false, 0, 0, 4);
    made.box({2, 0, 0}, {3, 1, 1});
    made.scene.polygons.pop_back();
    made.scene.polygons.erase(made.scene.polygons.begin() + 8);
    expect({{"border-edge", 4 + 6}});
    const CheckReport report = check(made.scene);
    ASSERT_EQ(report.components.size(), 2u);
    EXPECT_EQ(report.components[0].borders, 1u);
    EXPECT_EQ(report.components[1].borders, 1u);
    EXPECT_FALSE(report.components[1].closed);
    EXPECT_EQ(report.components[1].volume, 0.0);
}

TEST_P(CheckScene, CountsNearVertices) {
    made.polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    made.polygon({{4 + gap, 0, 0}, {8, 1, 0}, {8, 4, 0}});
    expect({{"near-vertex", 1}, {"border-edge", 6}});
}

TEST_P(CheckScene, CountsFacesWithoutArea) {
    made.polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    made.polygon({{5, 0, 0}, {6, 0, 0}, {8, 0, 0}});
    made.polygon({{5, 1, 1}, {6, 1, 1}, {8, 1, 1}, {7, 1, 1}});  // gives no triangle
    made.polygon({{5, 0, 3}, {5, 0, 3}, {5, 2, 3}});
    expect({{"zero-area", 2}, {"repeated-index", 1}, {"border-edge", 6}});
}

TEST_P(CheckScene, CountsNeedles) {
    made.polygon({{0, 0, 0}, {4, 0, 0}, {2, 0x1p-12, 0}});  // height 6e-5 of the edge
    made.polygon({{0, 0, 2}, {4, 0, 2}, {2, 0x1p-10, 2}});
    expect({{"needle", 1}, {"border-edge", 6}});
}

TEST_P(CheckScene, CountsFacesThatAreThereTwice) {
    const std::uint32_t other = made.material();
    for (int i = 0; i < 3; ++i) {
        const double x = 4 * i;
        made.polygon({{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}, 0, 0);
        if (i == 0) made.polygon({{x, 1, 0}, {x, 0, 0}, {x + 1, 0, 0}}, 0, 1);
        if (i > 0) made.polygon({{x, 1, 0}, {x + 1, 0, 0}, {x, 0, 0}}, i == 1 ? 0 : other, 1);
    }
    expect({{"duplicate-face", 1},
            {"opposite-face", 1},
            {"two-material-wall", 1},
            {"flipped-edge", 3}});
    for (const ObjectCounts& object : check(made.scene).objects)
        EXPECT_EQ(counts_of(object.counts), counts_of(check(made.scene).counts));
}

TEST_P(CheckScene, CountsEdgesAndVerticesThatAreNoManifold) {
    made.polygon({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}});
    made.polygon({{0, 0, 1}, {0, 0, 0}, {-1, 1, 0}});
    made.polygon({{0, 0, 0}, {0, 0, 1}, {-1, -1, 0}});
    made.polygon({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}});
    expect({{"nonmanifold-edge", 1}, {"nonmanifold-vertex", 1}, {"border-edge", 9}});
}

TEST_P(CheckScene, CountsFlippedEdges) {
    made.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    made.polygon({{1, 1, 0}, {2, 1, 0}, {2, 0, 0}, {1, 0, 0}});
    expect({{"flipped-edge", 1}, {"border-edge", 6}});
}

TEST_P(CheckScene, CountsTJunctions) {
    made.polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    made.polygon({{0, 0, 0}, {0, -2, 0}, {2, -gap, 0}});
    made.polygon({{2, -gap, 0}, {0, -2, 0}, {4, 0, 0}});
    expect({{"t-junction", 1}, {"nonmanifold-vertex", 2}, {"border-edge", 7}});
}

TEST_P(CheckScene, CountsPairsThatMeet) {
    made.polygon({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}});
    made.polygon({{1, 1, -1}, {2, 1, -1}, {1, 1, 1}}, 0, 0);     // passes through
    made.polygon({{1, 3, -1}, {2, 3, -1}, {1, 3, 1}}, 0, 1);     // of another object
    made.polygon({{3, 1, 0}, {3, 1, 2}, {4, 1, 2}}, 0, 1);       // stands on it with a corner
    made.polygon({{-1, -1, 0}, {1, 0.5, 0}, {-1, 3, 0}}, 0, 1);  // in its plane
    expect({{"self-intersection", 1},
            {"object-intersection", 2},
            {"coplanar-overlap", 1},
            {"border-edge", 15}});
    const CheckReport report = check(made.scene);
    EXPECT_EQ(counts_of(report.objects[1].counts),
              (Counts{{"object-intersection", 2}, {"coplanar-overlap", 1}, {"border-edge", 9}}));
}

TEST_P(CheckScene, CountsWhatHasNoOrientation) {
    constexpr int squares = 5;
    std::array<std::array<std::uint32_t, 2>, squares> rungs{};
    const std::array<glm::dvec2, squares> places{{{4, 0}, {1, 4}, {-3, 2}, {-3, -2}, {1, -4}}};
    for (int i = 0; i < squares; ++i) {
        const glm::dvec3 p(places[i], 0);
        const glm::dvec3 lean = i < 3 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0.5);
        rungs[i] = {made.vertex(p - lean), made.vertex(p + lean)};
    }
    for (int i = 0; i < squares; ++i) {
        auto next = rungs[(i + 1) % squares];
        if (i + 1 == squares) std::swap(next[0], next[1]);
        made.face({rungs[i][0], next[0], next[1]});
        made.face({rungs[i][0], next[1], rungs[i][1]});
    }
    const CheckReport report = check(made.scene);
    const Counts counts = counts_of(report.counts);
    EXPECT_EQ(counts.at("non-orientable"), 1u);
    EXPECT_EQ(counts.at("border-edge"), 10u);
    ASSERT_EQ(report.components.size(), 1u);
    EXPECT_FALSE(report.components[0].orientable);
    EXPECT_EQ(report.components[0].borders, 1u);
}

TEST_P(CheckScene, MeasuresThinWalls) {
    constexpr double thickness = 0x1p-13;  // 1.2e-4, over a diagonal of 4.2
    made.box({0, 0, 0}, {4, 4, thickness});
    made.box({0, 0, 1}, {4, 4, 2});
    const CheckReport report = check(made.scene);
    EXPECT_EQ(
        counts_of(report.counts),
        (Counts{{"needle", 8}, {"thin-wall", report.counts[std::size_t(Defect::thin_wall)]}}));
    // Of two triangles a side at least one has its centre before one it shares no vertex with.
    EXPECT_GE(report.counts[std::size_t(Defect::thin_wall)], 2u);
    EXPECT_EQ(report.thinnest_wall, thickness * GetParam().scale);
}

TRANSILLUM_AT_ALL_PLACES(CheckScene);

/// A cube's sides cut into n x n squares of two triangles each, blown up to a sphere.
PlacedScene sphere(int n) {
    PlacedScene made(testing_support::placements[0]);
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-n, n})
            for (int i = -n; i < n; i += 2)
                for (int j = -n; j < n; j += 2) {
                    std::vector<glm::dvec3> outline;
                    for (const auto& [di, dj] :
                         {std::pair{0, 0}, std::pair{2, 0}, std::pair{2, 2}, std::pair{0, 2}}) {
                        glm::dvec3 p;
                        p[axis] = side;
                        p[(axis + 1) % 3] = i + di;
                        p[(axis + 2) % 3] = j + dj;
                        outline.push_back(p / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z));
                    }
                    if (side < 0) std::ranges::reverse(outline);
                    made.polygon({outline[0], outline[1], outline[2]});
                    made.polygon({outline[0], outline[2], outline[3]});
                }
    return made;
}

TEST(CheckReports, FindNothingOnASphere) {
    const CheckReport report = check(sphere(20).scene);
    EXPECT_EQ(counts_of(report.counts), Counts());
    ASSERT_EQ(report.components.size(), 1u);
    EXPECT_TRUE(report.components[0].closed);
    EXPECT_GT(report.components[0].volume, 4.0);
}

TEST(CheckReports, DoNotDependOnTheNumberOfThreads) {
    PlacedScene made = sphere(12);
    made.box({-2, -0.0625, -0.0625}, {2, 0.0625, 0.0625});
    Monitor silent;
    const CheckReport one = check_scene(made.scene, {}, Workers(1), silent);
    const CheckReport three = check_scene(made.scene, {}, Workers(3), silent);
    EXPECT_EQ(one.counts, three.counts);
    EXPECT_GT(one.counts[std::size_t(Defect::self_intersection)], 0u);
    ASSERT_EQ(one.sites.size(), three.sites.size());
    for (std::size_t i = 0; i < one.sites.size(); ++i)
        EXPECT_EQ(one.sites[i].vertices, three.sites[i].vertices);
}

TEST(CheckReports, NeedPolygons) {
    EXPECT_THROW((void)check(PlacedScene(testing_support::placements[0]).scene), InputError);
}

}  // namespace
}  // namespace transillum
