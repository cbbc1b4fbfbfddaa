#include "support/scene_builder.h"

#include <transillum/base/sampling.h>
#include <transillum/geometry/leaf_means.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace transillum {
namespace {

using testing_support::SceneBuilder;

void expect_near(const Spectrum& a, const Spectrum& b, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

/// Texture coordinates that are an affine function of the position.
glm::vec2 uv_of(const glm::dvec3& p) {
    return {0.25 * p.x + 0.5 * p.y + 0.125, 0.75 * p.y - 0.25 * p.x};
}

void add_uvs(Scene& scene) {
    scene.uvs.clear();
    for (const std::uint32_t corner : scene.corners)
        scene.uvs.push_back(uv_of(scene.positions[corner]));
}

/// A square of two roots that the whole image covers.
SurfaceMesh square() {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    for (const std::uint32_t corner : builder.scene.corners)
        builder.scene.uvs.emplace_back(builder.scene.positions[corner]);
    return builder.surface();
}

Texture noise(int width, int height) {
    Random random(1, 1);
    Texture texture;
    texture.width = width;
    texture.height = height;
    for (int i = 0; i < width * height; ++i)
        texture.texels.emplace_back(random.next(), random.next(), random.next());
    texture.build_levels();
    return texture;
}

TEST(LeafMeans, UvsSurviveTriangulation) {
    SceneBuilder builder;
    // Concave; along a seam; degenerate and repeated, both dropped; and a triangle.
    builder.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}});
    builder.polygon({{0, 0, 1},
                     {4, 0, 1},
                     {4, 4, 1},
                     {0, 4, 1},
                     {0, 0, 1},
                     {1, 1, 1},
                     {1, 2, 1},
                     {2, 1, 1},
                     {1, 1, 1}});
    builder.polygon({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}});
    builder.polygon({{0, 0, 2}, {1, 0, 2}, {1, 1, 2}});
    builder.polygon({{0, 0, 2}, {1, 0, 2}, {1, 1, 2}});
    add_uvs(builder.scene);
    const SurfaceMesh mesh = builder.surface();
    ASSERT_EQ(mesh.uvs.size(), 3 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i)
        EXPECT_EQ(mesh.uvs[i], uv_of(mesh.positions[mesh.triangles[i / 3].vertices[i % 3]]));
}

TEST(LeafMeans, UvOfAPointIsThatOfItsPosition) {
    SceneBuilder builder;
    builder.polygon({{0, 0, 0}, {4, 1, 0}, {3, 4, 0}});
    EXPECT_EQ(uv_at(builder.surface(), 0, 0.5f, 0.25f), glm::vec2(0.0f)) << "without any";
    add_uvs(builder.scene);
    const SurfaceMesh mesh = builder.surface();
    for (const glm::ivec2 b : {glm::ivec2(0, 0), {4, 0}, {0, 4}, {1, 2}, {2, 1}}) {
        const glm::vec2 expected = uv_of(point_of_root(mesh, 0, b, 2));
        const glm::vec2 uv =
            uv_at(mesh, 0, static_cast<float>(b.x) / 4.0f, static_cast<float>(b.y) / 4.0f);
        EXPECT_FLOAT_EQ(uv.x, expected.x);
        EXPECT_FLOAT_EQ(uv.y, expected.y);
    }
}

TEST(LeafMeans, LeavesShareOutTheMeanOfTheImage) {
    const SurfaceMesh mesh = square();
    for (const auto& [width, height] : {std::pair(1, 1), {7, 5}, {64, 64}}) {
        const Texture texture = noise(width, height);
        for (const auto& levels : {std::vector{0, 0}, {1, 3}, {5, 2}}) {
            const PatchHierarchy patches = subdivide_to_levels(levels);
            SpectrumSum sum(0.0);
            for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf)
                sum += area_of_leaf(mesh, patches, leaf) *
                       SpectrumSum(texture_mean_over_leaf(mesh, patches, texture, leaf));
            expect_near(Spectrum(sum), texture.mean(), 1e-6f);
        }
    }
}

TEST(LeafMeans, OfALinearTextureAreItsValuesAtTheCentroids) {
    const SurfaceMesh mesh = square();
    Texture texture;
    texture.width = texture.height = 2;
    texture.wrap_u = texture.wrap_v = Texture::Wrap::clamp;
    // Linear between the centres: u from 1/4 to 3/4, and v.
    texture.texels = {{0.25f, 0.25f, 1}, {0.75f, 0.25f, 1}, {0.25f, 0.75f, 1}, {0.75f, 0.75f, 1}};
    const PatchHierarchy patches = subdivide_to_levels({4, 4});
    int inner = 0;
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf) {
        glm::vec2 centroid(0.0f);
        bool is_inner = true;
        for (const glm::ivec2 b : leaf_corners(patches, leaf).b) {
            const glm::dvec3 p = point_of_root(mesh, patches.root_of_leaf[leaf], b, 4);
            is_inner &= p.x >= 0.25 && p.x <= 0.75 && p.y >= 0.25 && p.y <= 0.75;
            centroid += glm::vec2(p) / 3.0f;
        }
        if (!is_inner) continue;
        ++inner;
        expect_near(texture_mean_over_leaf(mesh, patches, texture, leaf),
                    {centroid.x, centroid.y, 1.0f}, 1e-6f);
    }
    EXPECT_EQ(inner, 2 * 8 * 8);
}

}  // namespace
}  // namespace transillum
