#include "render/shadow_edges.h"
#include "support/scene_builder.h"
#include "unit/render/dark_solution.h"
#include "unit/render/surface_builder.h"

#include <transillum/render/render_solution.h>
#include <transillum/solution/bake.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace transillum {
namespace {

using namespace testing_support;

/// A floor of 4^3 leaves a root that all samples shine on.
struct Floor {
    Solution solution;
    VertexGrid grid;

    explicit Floor(std::size_t samples) {
        SurfaceBuilder builder;
        const auto m = builder.material(Spectrum(0.5f));
        builder.quad({{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}, m, 0);
        solution = dark_solution(builder.build(), 3);
        solution.direct.samples.resize(samples);
        for (LightSample& sample : solution.direct.samples) sample.position = {0, 0, 1};
        solution.direct.view_pixel = solution.direct.parallel_pixel = 0.01;
        solution.direct.geometry_factor.assign(samples * patches().patch_count(), 0.0f);
        solution.direct.visibility = solution.direct.geometry_factor;
        std::fill_n(solution.direct.geometry_factor.begin(), samples * patches().leaf_count, 1.0f);
        grid = build_vertex_grid(solution.surface, patches());
    }
    [[nodiscard]] const PatchHierarchy& patches() const { return solution.patches; }
    float& visibility(std::uint32_t patch, std::size_t sample) {
        return solution.direct.visibility[patch * solution.direct.samples.size() + sample];
    }
    float& geometry_factor(std::uint32_t patch, std::size_t sample) {
        return solution.direct.geometry_factor[patch * solution.direct.samples.size() + sample];
    }
    [[nodiscard]] ShadowEdges edges() const { return ShadowEdges(solution, grid, Workers(1)); }
    [[nodiscard]] bool touch(std::uint32_t a, std::uint32_t b) const {
        for (const std::uint32_t v : grid.leaf_vertices[a])
            for (const std::uint32_t w : grid.leaf_vertices[b])
                if (v == w) return true;
        return false;
    }
};

enum class Found { seen, hidden, doubtful };

Found found(const ShadowEdges& edges, std::uint32_t patch, std::size_t sample) {
    const ShadowEdges::Word& word = edges.at(patch, sample / ShadowEdges::samples_a_word);
    const std::uint64_t bit = std::uint64_t{1} << (sample % ShadowEdges::samples_a_word);
    EXPECT_EQ(word.seen & word.doubtful, 0u);
    return (word.doubtful & bit) != 0 ? Found::doubtful
           : (word.seen & bit) != 0   ? Found::seen
                                      : Found::hidden;
}

/// Sample 70 is seen by patches before an edge, hidden from those past it, seen in part on it.
TEST(ShadowEdges, AreDoubtfulAsFarAsTheNextPatch) {
    constexpr std::size_t samples = 75, on_edge = 70, lit = 3, dark = 64;
    Floor floor(samples);
    const std::uint32_t leaves = floor.patches().leaf_count, edge = 50;
    for (std::uint32_t p = 0; p < leaves; ++p) {
        floor.visibility(p, lit) = 1.0f;
        floor.visibility(p, on_edge) = p < edge ? 1.0f : p > edge ? 0.0f : 0.4f;
    }
    const ShadowEdges edges = floor.edges();
    ASSERT_EQ(edges.words(), 2u);
    double doubtful = 0.0;
    for (std::uint32_t p = 0; p < leaves; ++p) {
        EXPECT_EQ(found(edges, p, lit), Found::seen);
        EXPECT_EQ(found(edges, p, dark), Found::hidden);
        bool lit_about = p<edge, dark_about = p> edge;
        for (std::uint32_t q = 0; q < leaves; ++q)
            if (floor.touch(p, q)) {
                lit_about = lit_about && q < edge;
                dark_about = dark_about && q > edge;
            }
        const Found expected = lit_about    ? Found::seen
                               : dark_about ? Found::hidden
                                            : Found::doubtful;
        EXPECT_EQ(found(edges, p, on_edge), expected) << "patch " << p;
        doubtful += expected == Found::doubtful;
    }
    EXPECT_GT(doubtful, 1.0);
    // The backs face none of the samples.
    for (std::uint32_t p = leaves; p < 2 * leaves; ++p)
        EXPECT_EQ(found(edges, p, on_edge), Found::hidden);
    double seen = leaves;  // sample 3
    for (std::uint32_t p = 0; p < leaves; ++p) seen += found(edges, p, on_edge) == Found::seen;
    EXPECT_DOUBLE_EQ(edges.doubtful_share(), doubtful / (doubtful + seen));
}

TEST(ShadowEdges, NeighboursBehindTheHorizonHaveNoSay) {
    Floor floor(1);
    const std::uint32_t leaves = floor.patches().leaf_count;
    for (std::uint32_t p = 0; p < leaves; ++p) {
        floor.visibility(p, 0) = p % 2 == 0 ? 1.0f : 0.0f;
        floor.geometry_factor(p, 0) = p % 2 == 0 ? 1.0f : 0.0f;
    }
    const ShadowEdges edges = floor.edges();
    for (std::uint32_t p = 0; p < leaves; ++p)
        EXPECT_EQ(found(edges, p, 0), p % 2 == 0 ? Found::seen : Found::doubtful);
}

/// Leaves a hundredth of a pixel in size saw nothing that can be relied upon.
TEST(ShadowEdges, AreDoubtfulInWhatNoPixelResolves) {
    Floor floor(2);
    std::ranges::fill(floor.solution.direct.visibility, 1.0f);
    floor.solution.direct.samples[1].kind = LightSample::Kind::directional;
    floor.solution.direct.view_pixel = 10.0;
    const ShadowEdges edges = floor.edges();
    for (std::uint32_t p = 0; p < floor.patches().leaf_count; ++p) {
        EXPECT_EQ(found(edges, p, 0), Found::doubtful);
        EXPECT_EQ(found(edges, p, 1), Found::seen);
    }
    floor.solution.direct.view_pixel = 0.0;
    EXPECT_EQ(found(floor.edges(), 0, 0), Found::doubtful) << "unknown";
}

/// One root is a single leaf, the other 4^3: those in the middle of the common edge touch the large
/// one by vertices that hang in it.
TEST(ShadowEdges, LeavesOfOtherSizeAreAsked) {
    Floor floor(1);
    Solution& s = floor.solution;
    s.patches = subdivide_to_levels({0, 3});
    floor.grid = build_vertex_grid(s.surface, s.patches);
    s.direct.geometry_factor.assign(s.patches.patch_count(), 1.0f);
    s.direct.visibility.assign(s.patches.patch_count(), 1.0f);
    ASSERT_EQ(s.patches.root_of_leaf[0], 0u);
    const auto on_common_edge = [&](std::uint32_t leaf) {
        int corners = 0;  // the diagonal x = y
        for (const glm::dvec3& p : points_of_leaf(s.surface, s.patches, leaf))
            corners += p.x == p.y;
        return corners > 0;
    };
    floor.visibility(0, 0) = 0.5f;
    const ShadowEdges of_large = floor.edges();
    for (std::uint32_t p = 1; p < s.patches.leaf_count; ++p)
        EXPECT_EQ(found(of_large, p, 0), on_common_edge(p) ? Found::doubtful : Found::seen) << p;
    floor.visibility(0, 0) = 1.0f;
    for (std::uint32_t p = 1; p < s.patches.leaf_count; ++p) {
        floor.visibility(p, 0) = 0.5f;
        EXPECT_EQ(found(floor.edges(), 0, 0), on_common_edge(p) ? Found::doubtful : Found::seen);
        floor.visibility(p, 0) = 1.0f;
    }
}

TEST(ShadowEdges, AreEverywhereWhereNothingIsKnown) {
    Floor floor(70);
    const ShadowEdges edges(floor.solution.direct);
    for (const std::uint32_t p : {0u, 7u, floor.patches().patch_count() - 1})
        for (std::size_t i = 0; i < 70; ++i) EXPECT_EQ(found(edges, p, i), Found::doubtful);
    EXPECT_DOUBLE_EQ(edges.doubtful_share(), 1.0);
    EXPECT_EQ(ShadowEdges(DirectLight{}).words(), 0u);
    EXPECT_DOUBLE_EQ(ShadowEdges(DirectLight{}).doubtful_share(), 0.0);
}

/// A lamp, a table under it, a pole thinner than a leaf: the picture is that of rays to all
/// samples, but for shadows that end within a pixel of the first shot's views.
TEST(ShadowEdges, LeaveThePictureAsItIs) {
    SceneBuilder b;
    const auto white = b.material(Spectrum(0.5f));
    const auto lamp = b.material(Spectrum(0.0f), Spectrum(10.0f));
    b.polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, white);
    b.polygon({{0.7, 0.6, 0.5}, {1.4, 0.6, 0.5}, {1.4, 1.3, 0.5}, {0.7, 1.3, 0.5}}, white);
    b.polygon({{1.6, 0.5, 0}, {1.61, 0.5, 0}, {1.61, 0.5, 0.8}, {1.6, 0.5, 0.8}}, white);
    b.polygon({{0.9, 0.9, 2}, {0.9, 1.1, 2}, {1.1, 1.1, 2}, {1.1, 0.9, 2}}, lamp);
    BakeOptions bake_options;
    bake_options.subdivision.leaf_target = 3000;
    bake_options.iteration.iterations = 1;
    Monitor silent;
    const Workers workers(2);
    const Solution s = bake(b.scene, bake_options, workers, silent);
    Camera camera;
    camera.eye = {1.0, -1.5, 1.8};
    camera.look_at = {1.0, 1.0, 0.0};
    camera.up = {0, 0, 1};
    RenderOptions options;
    options.width = options.height = 150;
    const Image found = render_solution(s, camera, options, workers, silent);
    options.direct = DirectShading::traced_everywhere;
    const Image everywhere = render_solution(s, camera, options, workers, silent);
    std::size_t lit = 0, different = 0;
    for (std::size_t i = 0; i < found.pixels.size(); ++i) {
        lit += everywhere.pixels[i].x > 0.0f;
        different += found.pixels[i] != everywhere.pixels[i];
    }
    EXPECT_GT(lit, 5000u);
    EXPECT_LT(different, lit / 1000);

    // What is stored decides, where it does.
    Solution unshadowed = s;
    std::ranges::fill(unshadowed.direct.visibility, 1.0f);
    EXPECT_EQ(render_solution(unshadowed, camera, options, workers, silent).pixels,
              everywhere.pixels);
    options.direct = DirectShading::traced;
    const Image bright = render_solution(unshadowed, camera, options, workers, silent);
    std::size_t brighter = 0;
    for (std::size_t i = 0; i < found.pixels.size(); ++i)
        brighter += bright.pixels[i].x > everywhere.pixels[i].x;
    EXPECT_GT(brighter, lit / 100);
}

}  // namespace
}  // namespace transillum
