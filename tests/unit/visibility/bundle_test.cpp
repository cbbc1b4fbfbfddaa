#include <transillum/base/error.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <limits>

namespace transillum {
namespace {

TEST(SampleBundle, IsAFrameWithOffsetsInRange) {
    for (std::uint32_t i = 0; i < 4096; ++i) {
        const Bundle b = sample_bundle(i, 3);
        const glm::dmat3 gram = glm::transpose(b.frame) * b.frame;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(gram[r][c], r == c ? 1.0 : 0.0, 4e-15);
        ASSERT_NEAR(glm::determinant(b.frame), 1.0, 4e-15);
        for (const double offset : {b.offset_x, b.offset_y}) {
            ASSERT_GE(offset, 0.0);
            ASSERT_LT(offset, 1.0);
        }
        ASSERT_GE(b.random_row, 0);
        ASSERT_LT(b.random_row, 256);
    }
}

/// A net of 2^12 points: means converge far faster than those of random directions, whose standard
/// error would be below 1/64 for components and offsets alike.
TEST(SampleBundle, IsUniformOverDirectionsTurnsAndOffsets) {
    constexpr int n = 4096;
    glm::dvec3 direction(0.0), squares(0.0), axis(0.0);
    double x = 0.0, y = 0.0, row = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const Bundle b = sample_bundle(i, 8);
        direction += b.frame[2] / double{n};
        squares += b.frame[2] * b.frame[2] / double{n};
        axis += b.frame[0] / double{n};
        x += b.offset_x / n;
        y += b.offset_y / n;
        row += (b.random_row + 0.5) / 256.0 / n;
    }
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(direction[k], 0.0, 1.0 / 64.0);
        EXPECT_NEAR(squares[k], 1.0 / 3.0, 1.0 / 64.0);
        EXPECT_NEAR(axis[k], 0.0, 1.0 / 64.0);
    }
    // One point in each of n strata: within half a stratum of the mean.
    EXPECT_NEAR(x, 0.5, 0.5 / n);
    EXPECT_NEAR(y, 0.5, 0.5 / n);
    EXPECT_NEAR(row, 0.5, 0.5 / n);
}

TEST(SampleBundle, FollowsFromIndexAndSeed) {
    EXPECT_EQ(sample_bundle(5, 1).frame, sample_bundle(5, 1).frame);
    EXPECT_NE(sample_bundle(5, 1).frame, sample_bundle(5, 2).frame);
    EXPECT_NE(sample_bundle(5, 1).frame, sample_bundle(6, 1).frame);
}

SurfaceMesh triangle() {
    SurfaceMesh mesh;
    mesh.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
    mesh.triangles = {{.vertices = {0, 1, 2}}};
    return mesh;
}

TEST(PixelSizeFor, DividesTheMeanWidthOfTheBounds) {
    EXPECT_DOUBLE_EQ(pixel_size_for(triangle(), 100), 7.0 / 2.0 / 100.0);
    for (const int bad : {-1, 0, 15, 8193})
        EXPECT_THROW((void)pixel_size_for(triangle(), bad), UsageError);
    EXPECT_NO_THROW((void)pixel_size_for(triangle(), 16));
    EXPECT_NO_THROW((void)pixel_size_for(triangle(), 8192));
}

TEST(TransilluminationBufferWindow, RefusesPixelsThatMakeItTooLarge) {
    const SurfaceMesh mesh = triangle();
    const PatchHierarchy patches = subdivide_to_levels({0});
    const auto make = [&](double size) { TransilluminationBuffer(mesh, patches, size); };
    EXPECT_NO_THROW(make(5.0 / 16381.0));
    EXPECT_THROW(make(5.0 / 16383.0), UsageError);
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(make(bad), UsageError) << bad;
}

TEST(TransilluminationBufferWindow, HoldsTheSceneAtItsLargest) {
    const SurfaceMesh mesh = triangle();
    const PatchHierarchy patches = subdivide_to_levels({0});
    TransilluminationBuffer buffer(mesh, patches, 5.0 / 2000.0);
    const Workers workers(1);
    for (std::uint32_t i = 0; i < 32; ++i) {
        Bundle bundle = sample_bundle(i, 1);
        bundle.offset_x = bundle.offset_y = 1.0 - 0x1p-33;
        buffer.trace(bundle, workers, [&](const TileLists& tile, int) {
            EXPECT_LE(tile.row0 + tile.height, buffer.window_height());
        });
        EXPECT_LE(buffer.window_width(), 2002);
    }
}

}  // namespace
}  // namespace transillum
