#include "transport/relative_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace transillum;

std::vector<DirectionPart> equal_parts(std::uint64_t length, std::uint64_t count) {
    std::vector<DirectionPart> parts;
    for (std::uint64_t i = 0; i < count; ++i)
        parts.push_back({i * length, (i + 1) * length, 1.0 / static_cast<double>(count)});
    return parts;
}

class Exponents : public testing::TestWithParam<double> {};

// Parts of a net, in equal shares, are that net.
TEST_P(Exponents, OfANetFollowFromItsParts) {
    const double a = GetParam();
    for (const std::uint64_t count : {1, 2, 4, 16})
        EXPECT_NEAR(variance_of_parts(equal_parts(64 / count, count), a), std::pow(64.0, -2.0 * a),
                    1e-12)
            << count << " parts";
}

// V(half) = V(net) + a quarter of the mean square difference of the halves.
TEST_P(Exponents, DivideIntoBothHalvesAndTheirDifference) {
    const double a = GetParam();
    const std::vector<DirectionPart> halves{{0, 32, 0.5}, {32, 64, -0.5}};
    EXPECT_NEAR(variance_of_parts(halves, a), std::pow(32.0, -2.0 * a) - std::pow(64.0, -2.0 * a),
                1e-12);
}

TEST_P(Exponents, AreFoundFromMoves) {
    const double a = GetParam(), c = 3.0;
    std::vector<AverageMove> moves;
    for (std::uint64_t half = 64; half <= 1024; half *= 2) {
        const std::vector<DirectionPart> halves{{0, half, -0.5}, {half, 2 * half, 0.5}};
        moves.push_back({halves, c * variance_of_parts(halves, a)});
    }
    const ErrorModel model = fit_error_model(moves);
    // Between what was put in and what is usual, much nearer to the first.
    EXPECT_NEAR(model.a, a, 0.1);
    const std::vector<DirectionPart> all{{0, 2048, 1.0}};
    EXPECT_NEAR(
        std::sqrt(model.c * variance_of_parts(all, model.a) / (c * variance_of_parts(all, a))), 1.0,
        0.25);
}

INSTANTIATE_TEST_SUITE_P(AsMeasured, Exponents, testing::Values(0.5, 0.75, 1.0));

// Independent directions: the variance of a weighted mean is that of its shares.
TEST(VarianceOfParts, OfIndependentDirectionsIsASum) {
    const std::vector<DirectionPart> parts{{0, 8, 0.2}, {8, 12, 0.3}, {12, 16, 0.5}};
    EXPECT_NEAR(variance_of_parts(parts, 0.5), 0.04 / 8 + 0.09 / 4 + 0.25 / 4, 1e-15);
}

}  // namespace
