#include "repair/defects/find_components.h"
#include "repair/defects/find_defects.h"
#include "repair/defects/measure_shell.h"
#include "unit/repair/random_soups.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {
namespace {

using Corners = std::array<std::uint32_t, 3>;

TriangleSoup soup_of(const std::vector<glm::dvec3>& positions,
                     const std::vector<Corners>& triangles) {
    TriangleSoup soup{positions, {}, {}};
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        soup.triangles.push_back({triangles[t], t});
    return soup;
}

/// Corners of the unit cube at (bit 0, bit 1, bit 2), fronts outwards.
const std::vector<Corners> cube{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

glm::dvec3 cube_corner(std::uint32_t i) {
    return {i & 1u ? 1.0 : 0.0, i & 2u ? 1.0 : 0.0, i & 4u ? 1.0 : 0.0};
}

struct Made {
    std::vector<Shell> shells;
    std::vector<Component> components;
};

/// Looks at all that must hold for any shell.
Made make_shells(const TriangleSoup& soup) {
    const EdgeTable edges(soup);
    const Sheets sheets = find_sheets(soup, edges);
    const Shells shells(soup, edges, sheets);
    Made made{{}, find_components(soup, testing_support::scene_of(soup), edges, sheets)};
    for (std::uint32_t s = 0; s < sheets.size(); ++s) {
        Shell shell = shells.make(s);
        const ShellMesh& mesh = shell.mesh;
        EXPECT_TRUE(CGAL::is_valid_face_graph(mesh));
        EXPECT_EQ(mesh.n_faces(), shell.faces.size());
        for (const auto face : mesh.faces()) {
            const Side side = shell.faces[static_cast<std::size_t>(face.idx())];
            EXPECT_EQ(sheets.sheet[side / 2], s);
            std::vector<glm::dvec3> corners, expected;
            for (const auto h : mesh.fh_range(face)) {
                const auto& p = mesh.point(mesh.from_vertex_handle(h));
                corners.emplace_back(p[0], p[1], p[2]);
                const std::uint32_t edge = shell.edges[static_cast<std::size_t>(h.idx())];
                EXPECT_EQ(edge / 3, side / 2);
            }
            for (const std::uint32_t v : soup.triangles[side / 2].vertices)
                expected.push_back(soup.positions[v]);
            if (side % 2) std::ranges::reverse(expected);
            const auto first = std::ranges::find(expected, corners[0]);
            EXPECT_TRUE(first != expected.end());
            std::ranges::rotate(expected, first);
            EXPECT_EQ(corners, expected);
        }
        made.shells.push_back(std::move(shell));
    }
    return made;
}

std::ptrdiff_t euler_characteristic(const ShellMesh& mesh) {
    return static_cast<std::ptrdiff_t>(mesh.n_vertices() + mesh.n_faces()) -
           static_cast<std::ptrdiff_t>(mesh.n_edges());
}

TEST(Shells, OfACubeEncloseIt) {
    std::vector<glm::dvec3> positions;
    for (std::uint32_t i = 0; i < 8; ++i) positions.push_back(3.0 * cube_corner(i));
    std::vector<Corners> triangles = cube;
    std::swap(triangles[5][0], triangles[5][1]);
    const Made made = make_shells(soup_of(positions, triangles));
    ASSERT_EQ(made.shells.size(), 1u);
    EXPECT_EQ(euler_characteristic(made.shells[0].mesh), 2);
    EXPECT_TRUE(is_closed(made.shells[0]));
    EXPECT_EQ(enclosed_volume(made.shells[0]), 27.0);
    EXPECT_TRUE(border_loops(made.shells[0]).empty());
}

// What meets in a vertex only has a vertex each.
TEST(Shells, AreApartWhereFansMeetInAVertex) {
    std::vector<glm::dvec3> positions;
    for (std::uint32_t i = 0; i < 8; ++i) positions.push_back(cube_corner(i));
    for (std::uint32_t i = 0; i < 7; ++i) positions.push_back(-cube_corner(7 - i));
    std::vector<Corners> triangles = cube;
    for (const Corners& t : cube) {
        // The second cube's corner 7 is the first one's 0.
        Corners other{};
        for (int c = 0; c < 3; ++c) other[c] = t[c] == 7 ? 0 : t[c] + 8;
        triangles.push_back(other);
    }
    const Made made = make_shells(soup_of(positions, triangles));
    ASSERT_EQ(made.shells.size(), 2u);
    for (const Shell& shell : made.shells) {
        EXPECT_EQ(shell.mesh.n_vertices(), 8u);
        EXPECT_TRUE(is_closed(shell));
    }
}

// Two fans of one sheet at a vertex: a pinched one.
TEST(Shells, HaveAVertexForEveryFan) {
    const std::vector<glm::dvec3> positions{{0, 0, 0},  {1, 0, 0}, {1, 1, 0}, {-1, 0, 0},
                                            {-1, 1, 0}, {1, 2, 1}, {-1, 2, 1}};
    // A bridge from one triangle at the origin to the other, far from it.
    const Made made = make_shells(
        soup_of(positions, {{0, 1, 2}, {2, 1, 5}, {2, 5, 6}, {2, 6, 4}, {4, 6, 3}, {0, 4, 3}}));
    ASSERT_EQ(made.shells.size(), 1u);
    EXPECT_EQ(made.shells[0].mesh.n_vertices(), 8u);
    EXPECT_EQ(made.components[0].borders, 1u);
    EXPECT_EQ(border_loops(made.shells[0])[0].size(), 8u);
}

// Cubes that share an edge: four faces are there, which no surface can join.
TEST(Shells, AreOpenAtEdgesOfMany) {
    std::vector<glm::dvec3> positions;
    for (std::uint32_t i = 0; i < 8; ++i) positions.push_back(cube_corner(i));
    for (std::uint32_t i = 0; i < 8; ++i) positions.push_back(cube_corner(i) - glm::dvec3(1, 1, 0));
    std::vector<Corners> triangles = cube;
    for (const Corners& t : cube) {
        Corners other{};
        for (int c = 0; c < 3; ++c) other[c] = t[c] == 3 ? 0 : t[c] == 7 ? 4 : t[c] + 8;
        triangles.push_back(other);
    }
    const Made made = make_shells(soup_of(positions, triangles));
    ASSERT_EQ(made.shells.size(), 2u);
    for (std::size_t s = 0; s < 2; ++s) {
        const Shell& shell = made.shells[s];
        EXPECT_EQ(shell.mesh.n_vertices(), 8u);
        EXPECT_EQ(euler_characteristic(shell.mesh), 1);
        EXPECT_FALSE(is_closed(shell));
        ASSERT_EQ(border_loops(shell).size(), 1u);
        EXPECT_EQ(border_loops(shell)[0].size(), 2u);
        EXPECT_FALSE(made.components[s].closed);
        EXPECT_EQ(made.components[s].borders, 0u);
    }
}

// The projective plane's is a sphere, a Moebius strip's a band.
TEST(Shells, OfWhatHasNoOrientationCoverItTwice) {
    std::mt19937 random(1);
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < 6; ++i) positions.emplace_back(random() % 64, random() % 64, i);
    const Made plane = make_shells(soup_of(positions, {{0, 1, 2},
                                                       {0, 2, 3},
                                                       {0, 3, 4},
                                                       {0, 4, 5},
                                                       {0, 5, 1},
                                                       {1, 2, 4},
                                                       {2, 3, 5},
                                                       {3, 4, 1},
                                                       {4, 5, 2},
                                                       {5, 1, 3}}));
    ASSERT_EQ(plane.shells.size(), 1u);
    EXPECT_EQ(plane.shells[0].mesh.n_faces(), 20u);
    EXPECT_EQ(euler_characteristic(plane.shells[0].mesh), 2);
    EXPECT_TRUE(plane.components[0].closed);
    EXPECT_FALSE(plane.components[0].orientable);
    EXPECT_EQ(plane.components[0].volume, 0.0);
    const Made strip =
        make_shells(soup_of(positions, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 0, 4}, {4, 0, 1}}));
    ASSERT_EQ(strip.shells.size(), 1u);
    EXPECT_EQ(strip.shells[0].mesh.n_faces(), 10u);
    EXPECT_EQ(euler_characteristic(strip.shells[0].mesh), 0);
    EXPECT_EQ(border_loops(strip.shells[0]).size(), 2u);
    EXPECT_EQ(strip.components[0].borders, 1u);
}

/// A torus of rings x sides squares, in two triangles each.
void add_torus(TriangleSoup& soup, std::uint32_t rings, std::uint32_t sides,
               const glm::dvec3& centre) {
    const auto base = static_cast<std::uint32_t>(soup.positions.size());
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return base + (i % rings) * sides + j % sides;
    };
    for (std::uint32_t i = 0; i < rings; ++i)
        for (std::uint32_t j = 0; j < sides; ++j) {
            const double u = 2.0 * std::numbers::pi * i / rings;
            const double v = 2.0 * std::numbers::pi * j / sides;
            const double r = 2.0 + std::cos(v);
            soup.positions.push_back(centre +
                                     glm::dvec3(r * std::cos(u), r * std::sin(u), std::sin(v)));
        }
    for (std::uint32_t i = 0; i < rings; ++i)
        for (std::uint32_t j = 0; j < sides; ++j) {
            const Corners a{at(i, j), at(i + 1, j), at(i + 1, j + 1)};
            const Corners b{at(i, j), at(i + 1, j + 1), at(i, j + 1)};
            soup.triangles.push_back({a, 0});
            soup.triangles.push_back({b, 0});
        }
}

struct Tori {
    TriangleSoup soup;
    std::vector<double> volumes;  ///< sorted
};

/// In any order, with every triangle turned at random.
Tori shuffled_tori(std::uint32_t seed) {
    std::mt19937 random(seed);
    Tori tori;
    TriangleSoup& soup = tori.soup;
    for (int i = 0; i < 4; ++i) {
        const auto rings = static_cast<std::uint32_t>(3 + random() % 12);
        const auto sides = static_cast<std::uint32_t>(3 + random() % 9);
        add_torus(soup, rings, sides, {10.0 * i, 0, 0});
        tori.volumes.push_back(rings * sides * std::sin(2.0 * std::numbers::pi / rings) *
                               std::sin(2.0 * std::numbers::pi / sides));
    }
    std::ranges::sort(tori.volumes);
    std::ranges::shuffle(soup.triangles, random);
    const std::uint64_t turned_of_eight = random() % 9;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        auto& v = soup.triangles[t].vertices;
        soup.triangles[t].polygon = t;
        std::rotate(v.begin(), v.begin() + static_cast<int>(random() % 3), v.end());
        if (random() % 8 < turned_of_eight) std::swap(v[0], v[1]);
    }
    return tori;
}

bool runs_alike(const Corners& a, const std::vector<std::size_t>& b) {
    const auto first = std::ranges::find(b, std::size_t{a[0]}) - b.begin();
    return b[static_cast<std::size_t>(first + 1) % 3] == a[1];
}

TEST(Flips, AreThoseOfCgalUpToTheSide) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const TriangleSoup soup = shuffled_tori(seed).soup;
        std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> points;
        for (const glm::dvec3& p : soup.positions) points.emplace_back(p.x, p.y, p.z);
        std::vector<std::vector<std::size_t>> polygons;
        for (const SoupTriangle& t : soup.triangles)
            polygons.emplace_back(t.vertices.begin(), t.vertices.end());
        ASSERT_TRUE(CGAL::Polygon_mesh_processing::orient_polygon_soup(points, polygons));
        const Flips flips = find_flips(soup, testing_support::scene_of(soup));
        const Sheets sheets = find_sheets(soup, EdgeTable(soup));
        ASSERT_EQ(sheets.size(), 4u);
        std::array<std::array<int, 2>, 4> counts{};
        for (std::size_t t = 0; t < polygons.size(); ++t) {
            const bool turned_there = !runs_alike(soup.triangles[t].vertices, polygons[t]);
            ++counts[sheets.sheet[t]][flips.turn[t] == turned_there ? 0 : 1];
        }
        for (const auto& [alike, other] : counts)
            EXPECT_EQ(std::min(alike, other), 0) << "seed " << seed;
    }
}

// By Pappus: sides and rings are regular polygons.
TEST(Components, OfToriEncloseTheSameHoweverShuffled) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const Tori tori = shuffled_tori(seed);
        std::vector<double> volumes;
        for (const Component& c : make_shells(tori.soup).components) {
            EXPECT_TRUE(c.closed && c.orientable);
            EXPECT_EQ(c.borders, 0u);
            volumes.push_back(std::abs(c.volume));
        }
        std::ranges::sort(volumes);
        EXPECT_THAT(volumes, testing::Pointwise(testing::DoubleNear(1e-11), tori.volumes));
    }
}

}  // namespace
}  // namespace transillum
