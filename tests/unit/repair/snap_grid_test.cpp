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

TEST(SnapScene, RefusesExtentsThatLightCannotBeWorkedOutAt) {
    for (const double extent : {1e300, 1.1e15, 0.9e-15, 1e-310, 5e-324}) {
        Scene scene = scattered(3);
        for (glm::dvec3& p : scene.positions) p = {0.0, 0.0, -extent};
        scene.path = "huge";
        try {
            snap_scene(scene, Rounding::dyadic);
            ADD_FAILURE() << extent;
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_TRUE(message.starts_with("huge: the largest coordinate is ")) << message;
            EXPECT_NE(message.find("accepted: 1e-15 to 1e+15"), std::string::npos) << message;
        }
        EXPECT_NO_THROW(snap_scene(scene, Rounding::doubles));
    }
    for (const double extent : {1e15, 1e-15, 0.0}) {
        Scene scene = scattered(3);
        for (glm::dvec3& p : scene.positions) p = {extent, 0.0, 0.0};
        EXPECT_NO_THROW(snap_scene(scene, Rounding::dyadic));
    }
}

/// Beside large coordinates, they are 0.
TEST(SnapScene, TakesDenormalNumbers) {
    Scene scene = scattered(3);
    scene.positions[0] = {5e-324, -1e-310, 1.0};
    snap_scene(scene, Rounding::dyadic);
    EXPECT_EQ(scene.positions[0], glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_FALSE(std::signbit(scene.positions[0].y));
}

}  // namespace

}  // namespace transillum
