#include <transillum/base/sampling.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

namespace transillum {
namespace {

/// Are there equally many points in every elementary interval of 2^-bits0 x 2^-bits1?
bool fills_intervals(std::uint32_t begin, int log_points, int dim0, int bits0, int dim1, int bits1,
                     std::uint64_t seed) {
    std::vector<int> count(std::size_t{1} << (bits0 + bits1));
    for (std::uint32_t i = 0; i < (1u << log_points); ++i) {
        const auto x =
            static_cast<std::size_t>(std::ldexp(sobol_owen(begin + i, dim0, seed), bits0));
        const auto y =
            static_cast<std::size_t>(std::ldexp(sobol_owen(begin + i, dim1, seed), bits1));
        ++count[(x << bits1) | y];
    }
    const int each = 1 << (log_points - bits0 - bits1);
    return std::ranges::all_of(count, [each](int n) { return n == each; });
}

TEST(Sobol, EveryAlignedBlockIsANetInEachDimension) {
    for (int dimension = 0; dimension < sobol_dimensions; ++dimension)
        for (int k = 0; k <= 12; ++k)
            for (const std::uint32_t block : {0u, 1u, 6u, 1021u})
                EXPECT_TRUE(fills_intervals(block << k, k, dimension, k, 0, 0, 77 + block))
                    << "dimension " << dimension << ", block " << block << " of 2^" << k;
}

TEST(Sobol, FirstTwoDimensionsFormAPlaneNet) {
    for (int k = 0; k <= 10; ++k)
        for (const std::uint32_t block : {0u, 1u, 5u, 4095u})
            for (int i = 0; i <= k; ++i)
                EXPECT_TRUE(fills_intervals(block << k, k, 0, i, 1, k - i, 3))
                    << "2^" << i << " x 2^" << k - i << ", block " << block;
}

/// The quality parameter of a Sobol' sequence is the sum of its polynomials' degrees less one: a
/// wrong polynomial or an even direction integer breaks it.
TEST(Sobol, PairsHaveTheQualityOfTheirPolynomials) {
    constexpr std::array<int, sobol_dimensions> degree{1, 1, 2, 3, 3, 4, 4, 5};
    constexpr int k = 12;
    for (int a = 0; a < sobol_dimensions; ++a)
        for (int b = a + 1; b < sobol_dimensions; ++b) {
            const int volume = k - (degree[a] - 1) - (degree[b] - 1);
            for (int i = 0; i <= volume; ++i)
                EXPECT_TRUE(fills_intervals(0, k, a, i, b, volume - i, 11)) << a << ", " << b;
        }
}

TEST(Sobol, SeedsAndDimensionsAreScrambledApart) {
    std::set<double> first;
    for (std::uint64_t seed = 0; seed < 200; ++seed)
        for (int d = 0; d < sobol_dimensions; ++d) first.insert(sobol_owen(0, d, seed));
    EXPECT_EQ(first.size(), 200u * sobol_dimensions);
}

/// Sum of (observed - expected)^2 / expected over equal bins: mean bins - 1, variance 2 (bins - 1).
double chi_squared(const std::vector<int>& observed) {
    double n = 0.0, sum = 0.0;
    for (const int o : observed) n += o;
    const double expected = n / static_cast<double>(observed.size());
    for (const int o : observed) sum += (o - expected) * (o - expected) / expected;
    return sum;
}

void expect_uniform(const std::vector<int>& observed) {
    const double freedom = static_cast<double>(observed.size()) - 1.0;
    EXPECT_NEAR(chi_squared(observed), freedom, 5.0 * std::sqrt(2.0 * freedom));
}

TEST(Sobol, EverySampleIsUniformOverSeeds) {
    for (const std::uint32_t index : {0u, 1u, 2u, 12345u, 0xffffffffu}) {
        std::vector<int> bins(64);
        for (std::uint64_t seed = 0; seed < 16384; ++seed)
            ++bins[static_cast<std::size_t>(64.0 * sobol_owen(index, 2, seed))];
        expect_uniform(bins);
    }
}

TEST(Sobol, StaysBelowOneAndRefusesUnknownDimensions) {
    for (std::uint32_t i = 0; i < 100000; ++i) {
        const double x = sobol_owen(i * 42949u, static_cast<int>(i % sobol_dimensions), i);
        ASSERT_GE(x, 0.0);
        ASSERT_LT(x, 1.0);
    }
    EXPECT_THROW((void)sobol_owen(0, -1, 0), std::out_of_range);
    EXPECT_THROW((void)sobol_owen(0, sobol_dimensions, 0), std::out_of_range);
}

/// Over the midpoints of an n x n grid the moments are sums that telescope: for z = 1 - 2u the mean
/// of z^2 is (1 - 1/n^2) / 3, and the turns sum to zero.
TEST(UniformDirection, HasTheMomentsOfTheSphere) {
    constexpr int n = 64;
    glm::dvec3 mean(0.0);
    glm::dmat3 second(0.0);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const glm::dvec3 d = uniform_direction((i + 0.5) / n, (j + 0.5) / n);
            EXPECT_NEAR(glm::length(d), 1.0, 1e-15);
            mean += d / double{n * n};
            second += glm::outerProduct(d, d) / double{n * n};
        }
    const double zz = (1.0 - 1.0 / (n * n)) / 3.0;
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(mean[i], 0.0, 1e-13);
        for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(second[i][j], i != j ? 0.0 : i == 2 ? zz : (1.0 - zz) / 2.0, 1e-13);
    }
}

TEST(CosineDirection, HasTheMomentsOfTheCosine) {
    constexpr int n = 64;
    double zz = 0.0, xx = 0.0, z = 0.0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const glm::dvec3 d = cosine_direction((i + 0.5) / n, (j + 0.5) / n);
            EXPECT_NEAR(glm::length(d), 1.0, 1e-15);
            EXPECT_GT(d.z, 0.0);
            zz += d.z * d.z / (n * n);
            xx += d.x * d.x / (n * n);
            z += d.z / (n * n);
        }
    EXPECT_NEAR(zz, 0.5, 1e-13);
    EXPECT_NEAR(xx, 0.25, 1e-13);
    // The midpoint rule is off by less than n^-1.5 at the square root's end.
    EXPECT_NEAR(z, 2.0 / 3.0, std::pow(n, -1.5));
    EXPECT_GT(cosine_direction(1.0 - 0x1p-33, 0.3).z, 0.0);
}

TEST(FrameAbout, IsOrthonormalAndRightHanded) {
    std::vector<glm::dvec3> normals;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0})
            for (const double tilt : {0.0, 1e-300, 1e-12, 1e-6}) {
                glm::dvec3 n(tilt);
                n[axis] = sign;
                normals.push_back(glm::normalize(n));
            }
    normals.push_back(glm::normalize(glm::dvec3(1.0)));
    Random random(5, 0);
    for (int i = 0; i < 10000; ++i) {
        const double u = random.next();
        normals.push_back(uniform_direction(u, random.next()));
    }
    for (const glm::dvec3& n : normals) {
        const glm::dmat3 f = frame_about(n);
        EXPECT_EQ(f[2], n);
        const glm::dmat3 gram = glm::transpose(f) * f;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) EXPECT_NEAR(gram[i][j], i == j ? 1.0 : 0.0, 2e-15);
        EXPECT_NEAR(glm::determinant(f), 1.0, 2e-15);
    }
}

TEST(RandomStream, IsUniformAloneAndInPairs) {
    Random random(1, 2);
    std::vector<int> bins(1000), pairs(32 * 32);
    for (int i = 0; i < 200000; ++i) {
        const double x = random.next();
        ASSERT_GE(x, 0.0);
        ASSERT_LT(x, 1.0);
        ++bins[static_cast<std::size_t>(1000.0 * x)];
        ++pairs[static_cast<std::size_t>(32.0 * x) * 32 +
                static_cast<std::size_t>(32.0 * random.next())];
    }
    expect_uniform(bins);
    expect_uniform(pairs);
}

TEST(RandomStream, FirstNumbersOfStreamsAndSeedsAreUniform) {
    std::vector<int> streams(100), seeds(100);
    for (std::uint64_t i = 0; i < 50000; ++i) {
        ++streams[static_cast<std::size_t>(100.0 * Random(7, i).next())];
        ++seeds[static_cast<std::size_t>(100.0 * Random(i, 7).next())];
    }
    expect_uniform(streams);
    expect_uniform(seeds);
}

TEST(RandomStream, FollowsFromSeedAndStream) {
    Random a(3, 4), b(3, 4), other_seed(4, 4), other_stream(3, 5);
    int equal_seed = 0, equal_stream = 0;
    for (int i = 0; i < 100; ++i) {
        const std::uint32_t bits = a.next_bits();
        EXPECT_EQ(bits, b.next_bits());
        equal_seed += bits == other_seed.next_bits();
        equal_stream += bits == other_stream.next_bits();
    }
    EXPECT_LE(equal_seed, 1);
    EXPECT_LE(equal_stream, 1);
}

TEST(HashBits, IsOneToOneAndFlipsHalfTheBits) {
    std::set<std::uint64_t> values;
    double flipped = 0.0;
    constexpr int n = 4096;
    for (std::uint64_t i = 0; i < n; ++i) {
        values.insert(hash_bits(i));
        flipped += std::popcount(hash_bits(i) ^ hash_bits(i ^ (std::uint64_t{1} << (i % 64))));
    }
    EXPECT_EQ(values.size(), std::size_t{n});
    // Binomial: 64 bits, variance 16 each time.
    EXPECT_NEAR(flipped / n, 32.0, 5.0 * 4.0 / std::sqrt(n));
}

}  // namespace
}  // namespace transillum
