/// CGAL's exact kernel is the oracle: what the program computes in double must equal it.
#include "support/scene_builder.h"

#include <transillum/base/sampling.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/split_leaves.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <map>

namespace transillum {
namespace {

using testing_support::SceneBuilder;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Exact::Point_3;

Point exact(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

/// Random triangles of a small cube, moved and scaled.
SurfaceMesh random_triangles(double scale, const glm::dvec3& move) {
    SceneBuilder builder;
    Random random(9, 1);
    // A number of the stream has 32 bits and might lie on the grid as it is.
    const auto coordinate = [&] { return random.next() / 3.0; };
    const auto point = [&] {
        const double x = coordinate(), y = coordinate();
        return scale * (glm::dvec3(x, y, coordinate()) + move);
    };
    for (int i = 0; i < 20; ++i) {
        const glm::dvec3 a = point(), b = point();
        builder.polygon({a, b, point()});
    }
    return builder.surface();
}

/// Some 2^-30 as high as they are long, beside faces of ordinary shape.
SurfaceMesh needles() {
    SceneBuilder builder;
    Random random(5, 5);
    for (int i = 0; i < 20; ++i) {
        const glm::dvec3 a(random.next() / 3.0, random.next(), 0.7), b = glm::dvec3(1.0) - a / 7.0;
        builder.polygon({a, b, (a + b) / 2.0 + glm::dvec3(0x1p-30, 0.0, 0x1p-32 / 3.0)});
        builder.polygon({b, a, {random.next(), 0.3, random.next()}});
    }
    return builder.surface();
}

/// Triangles that share edges, in several sizes.
SurfaceMesh ball(double radius, const glm::dvec3& centre) {
    SceneBuilder builder;
    builder.sphere(centre, radius, 9, testing_support::Facing::inwards);
    return builder.surface();
}

const std::vector<SurfaceMesh>& placed_meshes() {
    static const std::vector<SurfaceMesh> meshes{needles(),
                                                 ball(1.0 / 3.0, {0.1, 0.2, 0.3}),
                                                 ball(1e-15, glm::dvec3(0.0)),
                                                 ball(0.9e15, glm::dvec3(0.0)),
                                                 ball(1.0, {1e6, 1e6 / 3.0, -1e6 / 7.0}),
                                                 ball(1e-3, {0.3, 1e3 / 3.0, 0.7}),
                                                 random_triangles(1.0, glm::dvec3(0.0)),
                                                 random_triangles(1e3, glm::dvec3(0.0)),
                                                 random_triangles(1e-3, glm::dvec3(-0.5)),
                                                 random_triangles(1.0, {1e6, -1e6, 3e5}),
                                                 random_triangles(0.7, {-0.5, -0.5, 1e6})};
    return meshes;
}

TEST(ExactSubdivision, VerticesAreSmallIntegersOfTheGrid) {
    for (const SurfaceMesh& mesh : placed_meshes()) {
        for (const glm::dvec3& p : mesh.positions)
            for (int axis = 0; axis < 3; ++axis) {
                const double integer = std::ldexp(p[axis], -mesh.grid.exponent);
                EXPECT_EQ(integer, std::nearbyint(integer));
                EXPECT_LE(std::abs(integer), 0x1p40);
            }
        const double spacing = std::ldexp(1.0, mesh.grid.exponent);
        EXPECT_LE(mesh.grid.largest_move, 0.5 * std::sqrt(3.0) * spacing * (1.0 + 1e-9));
        EXPECT_GT(mesh.grid.largest_move, 0.0);
        EXPECT_FALSE(mesh.triangles.empty());
    }
}

TEST(ExactSubdivision, PointsOfTheDeepestLevelAreExact) {
    constexpr int level = max_subdivision_level, n = 1 << level;
    Random random(2, 2);
    for (const SurfaceMesh& mesh : placed_meshes())
        for (std::uint32_t root = 0; root < mesh.triangles.size(); ++root)
            for (int i = 0; i < 20; ++i) {
                const int b1 = static_cast<int>(random.next() * (n + 1));
                const int b2 = static_cast<int>(random.next() * (n + 1 - b1));
                const auto& v = mesh.triangles[root].vertices;
                const Point a = exact(mesh.positions[v[0]]);
                const Point expected = a + ((exact(mesh.positions[v[1]]) - a) * b1 +
                                            (exact(mesh.positions[v[2]]) - a) * b2) /
                                               n;
                EXPECT_TRUE(exact(point_of_root(mesh, root, {b1, b2}, level)) == expected);
            }
}

/// Down to one level more than leaves have, midpoints of midpoints need no rounding.
TEST(ExactSubdivision, MidpointsOfMidpointsAreExact) {
    Random random(3, 3);
    for (const SurfaceMesh& mesh : placed_meshes())
        for (const RootTriangle& t : mesh.triangles) {
            std::array<glm::dvec3, 3> p;
            std::array<Point, 3> q;
            for (int i = 0; i < 3; ++i) q[i] = exact(p[i] = mesh.positions[t.vertices[i]]);
            for (int level = 1; level <= max_subdivision_level + 1; ++level) {
                const std::array<glm::dvec3, 3> m{(p[0] + p[1]) / 2.0, (p[1] + p[2]) / 2.0,
                                                  (p[2] + p[0]) / 2.0};
                const std::array<Point, 3> e{CGAL::midpoint(q[0], q[1]), CGAL::midpoint(q[1], q[2]),
                                             CGAL::midpoint(q[2], q[0])};
                for (int i = 0; i < 3; ++i) ASSERT_TRUE(exact(m[i]) == e[i]) << "level " << level;
                const int child = static_cast<int>(4.0 * random.next());
                if (child == 3) {
                    p = m;
                    q = e;
                } else {
                    const int last = (child + 2) % 3;
                    p = {p[child], m[child], m[last]};
                    q = {q[child], e[child], e[last]};
                }
            }
        }
}

Exact::Vector_3 exact_area(const std::array<glm::dvec3, 3>& p) {
    return CGAL::cross_product(exact(p[1]) - exact(p[0]), exact(p[2]) - exact(p[0]));
}

/// Leaves of several levels within roots, at random.
PatchHierarchy uneven_patches(std::size_t roots, int phases, std::uint64_t seed) {
    Random random(seed, 6);
    PatchHierarchy patches = subdivide_to_levels(std::vector<int>(roots, 1));
    for (int phase = 0; phase < phases; ++phase) {
        std::vector<std::uint8_t> split(patches.leaf_count);
        for (auto& s : split) s = random.next() < 0.4;
        patches = split_leaves(patches, split).patches;
    }
    return patches;
}

TEST(ExactSubdivision, AreaIsConservedByTheLeaves) {
    for (const SurfaceMesh& mesh : placed_meshes()) {
        const PatchHierarchy patches = uneven_patches(mesh.triangles.size(), 4, 7);
        std::vector<Exact::Vector_3> sum(mesh.triangles.size(), CGAL::NULL_VECTOR);
        for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
            Exact::Vector_3& s = sum[patches.root_of_leaf[leaf]];
            s = s + exact_area(points_of_leaf(mesh, patches, leaf));
        }
        for (std::uint32_t root = 0; root < mesh.triangles.size(); ++root) {
            const auto& v = mesh.triangles[root].vertices;
            EXPECT_TRUE(sum[root] == exact_area({mesh.positions[v[0]], mesh.positions[v[1]],
                                                 mesh.positions[v[2]]}));
        }
    }
}

/// Along an edge that two roots share, both have the same points, to the bit, at any two levels.
TEST(ExactSubdivision, NeighboursHaveThePointsOfTheirEdgeInCommon) {
    const std::array<glm::ivec2, 3> corner{glm::ivec2(0, 0), {1, 0}, {0, 1}};
    std::size_t shared = 0;
    for (const SurfaceMesh& mesh : placed_meshes()) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::pair<int, int>>> edges;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            for (int i = 0; i < 3; ++i) {
                const auto& v = mesh.triangles[t].vertices;
                edges[std::minmax(v[i], v[(i + 1) % 3])].emplace_back(t, i);
            }
        const auto at = [&](const std::pair<int, int>& side, int k, int level) {
            const auto& [t, i] = side;
            const auto& v = mesh.triangles[t].vertices;
            const int n = 1 << level;
            const int along = v[i] < v[(i + 1) % 3] ? k : n - k;
            return point_of_root(mesh, t, (n - along) * corner[i] + along * corner[(i + 1) % 3],
                                 level);
        };
        for (const auto& [edge, sides] : edges) {
            if (sides.size() != 2) continue;
            ++shared;
            for (const auto& [coarse, fine] : {std::pair(3, 3), {2, 5}, {1, max_subdivision_level}})
                for (int k = 0; k <= 1 << coarse; ++k)
                    ASSERT_EQ(at(sides[0], k, coarse), at(sides[1], k << (fine - coarse), fine));
        }
    }
    EXPECT_GT(shared, 100u);
}

TEST(ExactSubdivision, NeedsTheSnapping) {
    SurfaceMesh mesh;
    mesh.positions = {{0.1, 0.7, 0.3}, {1.0 / 3.0, 0.9, -0.2}, {5.1, 3.3, 0.77}};
    mesh.triangles = {{.vertices = {0, 1, 2}}};
    const Point a = exact(mesh.positions[0]), b = exact(mesh.positions[1]);
    EXPECT_FALSE(exact(point_of_root(mesh, 0, {1001, 0}, 11)) == a + (b - a) * 1001 / 2048);
}

}  // namespace
}  // namespace transillum
