#include "render/vertex_grid.h"
#include "support/random_hierarchy.h"
#include "unit/render/surface_builder.h"

#include <transillum/base/sampling.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <map>
#include <optional>

namespace transillum {
namespace {

using testing_support::random_hierarchy;
using testing_support::SurfaceBuilder;

/// A tilted square of 3 x 2 quads.
SurfaceMesh smooth_square() {
    SurfaceBuilder builder;
    const auto grey = builder.material(Spectrum(0.5f));
    const auto at = [](int i, int j) { return glm::dvec3(i, j, 0.5 * i - 0.25 * j); };
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 2; ++j)
            builder.quad({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, grey, 0);
    return builder.build();
}

Spectrum linear(const glm::dvec3& p) {
    return Spectrum(3.0 + p.x - 0.5 * p.y, 2.0 + 0.1 * p.x, 7.0);
}

std::vector<Spectrum> sampled_linear(const VertexGrid& grid) {
    std::vector<Spectrum> values;
    for (const glm::dvec3& c : grid.leaf_centres) values.push_back(linear(c));
    return values;
}

std::vector<float> uneven_weights(std::size_t n) {
    Random random(5, 0);
    std::vector<float> weights(n);
    for (float& w : weights) w = 0.2f + static_cast<float>(random.next());
    return weights;
}

class LinearField : public ::testing::TestWithParam<PatchHierarchy> {};

TEST_P(LinearField, IsReproducedAtEveryVertexBordersIncluded) {
    const SurfaceMesh mesh = smooth_square();
    const PatchHierarchy& patches = GetParam();
    const VertexGrid grid = build_vertex_grid(mesh, patches);
    const auto values =
        vertex_values(grid, sampled_linear(grid), uneven_weights(patches.leaf_count), Workers(2));
    for (std::size_t v = 0; v < values.size(); ++v)
        for (int c = 0; c < channel_count; ++c)
            EXPECT_NEAR(values[v][c], linear(grid.positions[v])[c], 2e-6f * 7.0f) << "vertex " << v;
}

INSTANTIATE_TEST_SUITE_P(Levels, LinearField,
                         ::testing::Values(subdivide_to_levels(std::vector<int>(12, 0)),
                                           subdivide_to_levels(std::vector<int>(12, 1)),
                                           subdivide_to_levels(std::vector<int>(12, 3)),
                                           subdivide_to_levels({2, 3, 1, 4, 2, 2, 3, 1, 1, 3, 2,
                                                                4}),
                                           random_hierarchy(std::vector<int>(12, 0), 2, 1),
                                           random_hierarchy(std::vector<int>(12, 0), 5, 2),
                                           random_hierarchy(std::vector<int>(12, 1), 4, 3),
                                           random_hierarchy(std::vector<int>(12, 2), 1, 4)));

TEST(VertexGrid, EveryVertexOfASmoothSquareIsSharedOnce) {
    const VertexGrid grid =
        build_vertex_grid(smooth_square(), subdivide_to_levels(std::vector<int>(12, 2)));
    EXPECT_EQ(grid.vertex_count(), std::size_t{13 * 9});
    EXPECT_TRUE(grid.hanging.empty());
}

TEST(VertexGrid, FinerVerticesLieOnTheCoarserNeighboursEdge) {
    SurfaceBuilder builder;
    builder.quad({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, builder.material(Spectrum(0.5f)),
                 0);
    const SurfaceMesh mesh = builder.build();
    const PatchHierarchy patches = subdivide_to_levels({1, 3});
    const VertexGrid grid = build_vertex_grid(mesh, patches);
    ASSERT_EQ(grid.hanging.size(), 6u);  // 7 between the ends, of which the coarser has 1
    for (const auto& h : grid.hanging) {
        const glm::dvec3 expected =
            glm::mix(grid.positions[h.from], grid.positions[h.to], double(h.share));
        EXPECT_EQ(grid.positions[h.vertex], expected);
    }
    Random random(1, 0);
    std::vector<Spectrum> noise(patches.leaf_count);
    for (Spectrum& s : noise) s = Spectrum(static_cast<float>(random.next()));
    const auto values = vertex_values(grid, noise, uneven_weights(patches.leaf_count), Workers(1));
    for (const auto& h : grid.hanging)
        EXPECT_EQ(values[h.vertex], glm::mix(values[h.from], values[h.to], h.share));
}

/// How far along a segment a point lies, if within it.
std::optional<double> share_of(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& p) {
    const double share = glm::dot(p - from, to - from) / glm::dot(to - from, to - from);
    if (!(share > 0.0 && share < 1.0)) return std::nullopt;
    // On the square's dyadic coordinates distances are exact but for the share's rounding.
    if (glm::distance(glm::mix(from, to, share), p) > 1e-12) return std::nullopt;
    return share;
}

TEST(VertexGrid, VerticesHangOnTheLongestEdgeTheyLieIn) {
    const SurfaceMesh mesh = smooth_square();
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const PatchHierarchy patches =
            random_hierarchy(std::vector<int>(12, static_cast<int>(seed % 2)), 3, seed);
        const VertexGrid grid = build_vertex_grid(mesh, patches);
        struct Edge {
            double length = 0.0, share = 0.0;
            std::uint32_t from = 0, to = 0;
        };
        std::vector<Edge> longest(grid.vertex_count());
        for (const auto& corners : grid.leaf_vertices)
            for (int c = 0; c < 3; ++c) {
                const std::uint32_t from = corners[c], to = corners[(c + 1) % 3];
                const glm::dvec3 &a = grid.positions[from], &b = grid.positions[to];
                for (std::uint32_t v = 0; v < grid.vertex_count(); ++v)
                    if (const auto share = share_of(a, b, grid.positions[v]))
                        if (glm::distance(a, b) > longest[v].length)
                            longest[v] = {glm::distance(a, b), *share, from, to};
            }
        std::vector<bool> done(grid.vertex_count(), true);
        for (const auto& h : grid.hanging) done[h.vertex] = false;
        std::size_t expected = 0, chains = 0;
        for (const Edge& e : longest) expected += e.length > 0.0;
        EXPECT_EQ(grid.hanging.size(), expected);
        for (const auto& h : grid.hanging) {
            const Edge& e = longest[h.vertex];
            ASSERT_GT(e.length, 0.0);
            const bool along = h.from == e.from;
            EXPECT_EQ(h.from, along ? e.from : e.to);
            EXPECT_EQ(h.to, along ? e.to : e.from);
            EXPECT_NEAR(h.share, along ? e.share : 1.0 - e.share, 1e-7);
            EXPECT_TRUE(done[h.from] && done[h.to]) << "before what it hangs on";
            chains += longest[h.from].length > 0.0 || longest[h.to].length > 0.0;
            done[h.vertex] = true;
        }
        EXPECT_GT(chains, 0u);
    }
}

/// Gouraud values along every edge of every leaf: what leaves on both sides say of a point agrees.
TEST(VertexValues, NoSeamShowsBetweenLeavesOfAnyLevels) {
    const SurfaceMesh mesh = smooth_square();
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const PatchHierarchy patches =
            random_hierarchy(std::vector<int>(12, static_cast<int>(seed % 2)), 4, seed);
        const VertexGrid grid = build_vertex_grid(mesh, patches);
        Random random(seed, 3);
        std::vector<Spectrum> noise(patches.leaf_count);
        for (Spectrum& s : noise) s = Spectrum(static_cast<float>(random.next()));
        const auto values =
            vertex_values(grid, noise, uneven_weights(patches.leaf_count), Workers(2));
        std::map<std::pair<double, double>, float> known;
        std::size_t met = 0;
        for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
            // All edges in one and the same step.
            const int steps = 1 << (6 - patches.level_of_leaf(leaf));
            for (int c = 0; c < 3; ++c) {
                const std::uint32_t from = grid.leaf_vertices[leaf][c],
                                    to = grid.leaf_vertices[leaf][(c + 1) % 3];
                for (int step = 0; step <= steps; ++step) {
                    const double share = double(step) / steps;
                    const glm::dvec3 p = glm::mix(grid.positions[from], grid.positions[to], share);
                    const float value =
                        glm::mix(values[from].x, values[to].x, static_cast<float>(share));
                    const auto [at, is_new] = known.try_emplace({p.x, p.y}, value);
                    EXPECT_NEAR(at->second, value, 1e-6f);
                    met += !is_new;
                }
            }
        }
        EXPECT_GT(met, known.size() / 2);
    }
}

TEST(VertexValues, NothingCrossesACrease) {
    SurfaceBuilder builder;
    const auto grey = builder.material(Spectrum(0.5f));
    builder.quad({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, grey, 0);
    builder.quad({{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}}, grey, 1);
    const PatchHierarchy patches = subdivide_to_levels({2, 2, 2, 2});
    const VertexGrid grid = build_vertex_grid(builder.build(), patches);
    std::vector<Spectrum> values(64, Spectrum(1.0f));
    std::fill(values.begin() + 32, values.end(), Spectrum(3.0f));
    const auto at_vertices = vertex_values(grid, values, std::vector<float>(64, 1.0f), Workers(1));
    for (std::uint32_t leaf = 0; leaf < 64; ++leaf)
        for (const std::uint32_t v : grid.leaf_vertices[leaf])
            EXPECT_EQ(at_vertices[v], values[leaf]);
}

TEST(VertexValues, ASharpEdgeDoesNotOvershoot) {
    const SurfaceMesh mesh = smooth_square();
    const PatchHierarchy patches = subdivide_to_levels(std::vector<int>(12, 3));
    const VertexGrid grid = build_vertex_grid(mesh, patches);
    std::vector<Spectrum> step;
    for (const glm::dvec3& c : grid.leaf_centres)
        step.emplace_back(c.x + 0.3 * c.y > 1.7 ? 1.0f : 0.0f);
    const auto values =
        vertex_values(grid, step, std::vector<float>(step.size(), 1.0f), Workers(1));
    for (const Spectrum& s : values) {
        EXPECT_GE(s.x, 0.0f);
        EXPECT_LE(s.x, 1.25f);
    }
}

TEST(VertexValues, LeavesHardlySeenHardlyCount) {
    const SurfaceMesh mesh = smooth_square();
    const PatchHierarchy patches = subdivide_to_levels(std::vector<int>(12, 2));
    const VertexGrid grid = build_vertex_grid(mesh, patches);
    std::vector<Spectrum> values(patches.leaf_count, Spectrum(2.0f));
    std::vector<float> weights(patches.leaf_count, 1.0f);
    values[40] = Spectrum(500.0f);
    weights[40] = 0.0f;
    for (const Spectrum& s : vertex_values(grid, values, weights, Workers(1)))
        EXPECT_NEAR(s.x, 2.0f, 0.01f);
    const std::vector<float> unseen(patches.leaf_count, 0.0f);
    values[40] = Spectrum(2.0f);
    for (const Spectrum& s : vertex_values(grid, values, unseen, Workers(1)))
        EXPECT_NEAR(s.x, 2.0f, 1e-6f);
}

}  // namespace
}  // namespace transillum
