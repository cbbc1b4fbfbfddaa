#include <transillum/base/error.h>
#include <transillum/repair/snap_grid.h>

#include <gtest/gtest.h>

#include <cmath>

namespace transillum {

namespace {

Scene scattered(int count) {
    Scene scene;
    for (int i = 0; i < count; ++i) {
        scene.corners.push_back(static_cast<std::uint32_t>(i));
        scene.positions.emplace_back(i / 3.0 + 0.1, -0.1, 0.7);
    }
    scene.polygons = {{.corner_count = static_cast<std::uint32_t>(count)}};
    return scene;
}

/// Compilers have been seen to leave some of such conversions out.
TEST(SnapScene, RoundsEveryPositionToFloats) {
    for (int count = 3; count < 40; ++count) {
        const Scene exact = scattered(count);
        Scene scene = exact;
        const SnapGrid grid = snap_scene(scene, Rounding::floats);
        double furthest = 0.0;
        for (std::size_t i = 0; i < scene.positions.size(); ++i) {
            double square = 0.0;
            for (int axis = 0; axis < 3; ++axis) {
                const volatile float rounded = static_cast<float>(exact.positions[i][axis]);
                const double expected = rounded;
                EXPECT_EQ(scene.positions[i][axis], expected) << count << ' ' << i;
                const double move = expected - exact.positions[i][axis];
                square += move * move;
            }
            furthest = std::max(furthest, std::sqrt(square));
        }
        EXPECT_DOUBLE_EQ(grid.largest_move, furthest);
    }
}

}  // namespace

}  // namespace transillum
