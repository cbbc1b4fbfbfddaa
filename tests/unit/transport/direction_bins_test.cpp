#include <transillum/base/sampling.h>
#include <transillum/transport/direction_bins.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace transillum;

TEST(DirectionBins, SquareAndHemisphereAreOneToOne) {
    for (int i = 0; i < 4096; ++i) {
        const auto u = static_cast<float>(sobol_owen(i, 0, 3)),
                   v = static_cast<float>(sobol_owen(i, 1, 3));
        const glm::vec3 d = direction_of_square({u, v});
        EXPECT_NEAR(glm::length(d), 1.0f, 1e-6f);
        EXPECT_GE(d.z, 0.0f);
        const glm::vec2 back = square_of_direction(d);
        EXPECT_NEAR(back.x, u, 2e-6f) << i;
        EXPECT_NEAR(back.y, v, 2e-6f) << i;
    }
    EXPECT_EQ(square_of_direction({0.0f, 0.0f, 1.0f}), glm::vec2(0.5f));
    EXPECT_EQ(direction_of_square({0.5f, 0.5f}), glm::vec3(0.0f, 0.0f, 1.0f));
}

// Cosine-weighted directions fill bins alike: that is what equal projected solid angle means. A
// power of two of a (0,2)-sequence, mapped with little distortion, misses by a few samples only;
// four standard deviations of random ones are a wide margin.
TEST(DirectionBins, HaveEqualProjectedSolidAngle) {
    const int n = 1 << 16;
    for (int level = 0; level <= max_bin_level; ++level) {
        std::vector<int> count(bin_count(level));
        for (int i = 0; i < n; ++i) {
            const glm::vec3 d(cosine_direction(sobol_owen(i, 0, 5), sobol_owen(i, 1, 5)));
            ++count[bin_at(square_of_direction(d), level)];
        }
        const double expected = static_cast<double>(n) / bin_count(level);
        for (const int c : count) EXPECT_NEAR(c, expected, 4.0 * std::sqrt(expected));
    }
}

TEST(DirectionBins, DividingOneIntoFourIsTheNextLevel) {
    for (int i = 0; i < 1024; ++i) {
        const glm::vec2 s(static_cast<float>(sobol_owen(i, 0, 9)),
                          static_cast<float>(sobol_owen(i, 1, 9)));
        for (int level = 0; level < max_bin_level; ++level) {
            const int side = 1 << level, fine = bin_at(s, level + 1);
            EXPECT_EQ(bin_at(s, level), fine / (2 * side) / 2 * side + fine % (2 * side) / 2);
        }
    }
}

TEST(BinFrame, IsRightHandedAboutTheNormal) {
    for (int i = 0; i < 1024; ++i) {
        const glm::dvec3 n = uniform_direction(sobol_owen(i, 0, 1), sobol_owen(i, 1, 1));
        const glm::dmat3 f = bin_frame(n);
        EXPECT_NEAR(glm::length(f[2] - n), 0.0, 1e-12);
        EXPECT_NEAR(glm::determinant(f), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(f[0], f[1]), 0.0, 1e-12);
    }
}

// Walls, floors and what is near them lie where frames turn no faster than normals do.
TEST(BinFrame, TurnsSlowlyAboutTheAxes) {
    const double step = 0.01;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 n(0.0);
            n[axis] = sign;
            glm::dvec3 near = n;
            near[(axis + 1) % 3] += step;
            near[(axis + 2) % 3] -= step;
            const glm::dvec3 m = glm::normalize(near);
            const double moved = glm::length(m - n);
            EXPECT_LT(glm::length(bin_frame(m)[0] - bin_frame(n)[0]), 4.0 * moved) << axis << sign;
        }
}

}  // namespace
