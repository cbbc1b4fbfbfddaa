#include "render/vertex_grid.h"
#include "unit/render/surface_builder.h"

#include <transillum/base/sampling.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>

namespace transillum {
namespace {

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

class LinearField : public ::testing::TestWithParam<std::vector<int>> {};

TEST_P(LinearField, IsReproducedAtEveryVertexBordersIncluded) {
    const SurfaceMesh mesh = smooth_square();
    const PatchHierarchy patches = subdivide_to_levels(GetParam());
    const VertexGrid grid = build_vertex_grid(mesh, patches);
    const auto values =
        vertex_values(grid, sampled_linear(grid), uneven_weights(patches.leaf_count), Workers(2));
    for (std::size_t v = 0; v < values.size(); ++v)
        for (int c = 0; c < channel_count; ++c)
            EXPECT_NEAR(values[v][c], linear(grid.positions[v])[c], 2e-6f * 7.0f) << "vertex " << v;
}

INSTANTIATE_TEST_SUITE_P(Levels, LinearField,
                         ::testing::Values(std::vector<int>(12, 0), std::vector<int>(12, 1),
                                           std::vector<int>(12, 3),
                                           std::vector<int>{2, 3, 1, 4, 2, 2, 3, 1, 1, 3, 2, 4}));

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
