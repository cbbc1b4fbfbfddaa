#include <transillum/base/sampling.h>
#include <transillum/scene/texture.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <functional>

namespace transillum {

namespace {

using Wrap = Texture::Wrap;
using Triangle = std::array<glm::vec2, 3>;

constexpr std::array<Wrap, 3> all_wraps{Wrap::repeat, Wrap::mirrored, Wrap::clamp};

Texture image(int width, int height, const std::function<Spectrum(int, int)>& texel,
              Wrap wrap = Wrap::repeat) {
    Texture texture;
    texture.width = width;
    texture.height = height;
    texture.wrap_u = texture.wrap_v = wrap;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) texture.texels.push_back(texel(x, y));
    return texture;
}

Texture noise(int width, int height, Wrap wrap = Wrap::repeat) {
    Random random(7, 1);
    return image(
        width, height,
        [&](int, int) {
            const auto r = static_cast<float>(random.next());
            return Spectrum(r, r * r, static_cast<float>(random.next()));
        },
        wrap);
}

Texture checkerboard(int n) {
    return image(n, n, [](int x, int y) { return Spectrum((x + y) % 2 == 0 ? 1.0f : 0.0f); });
}

/// u to the right, v downwards, exactly linear between the outermost texel centres.
Texture ramp(int n) {
    return image(
        n, n,
        [&](int x, int y) {
            const auto centre = [&](int i) {
                return (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
            };
            return Spectrum(centre(x), centre(y), 0.25f);
        },
        Wrap::clamp);
}

double area(const Triangle& t) {
    const glm::dvec2 a(t[1] - t[0]), b(t[2] - t[0]);
    return 0.5 * std::abs(a.x * b.y - a.y * b.x);
}

void expect_near(const Spectrum& a, const Spectrum& b, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

/// The unit square in triangles: a grid of n x n points, the inner ones moved at random.
std::vector<Triangle> tiling(int n, std::uint64_t seed) {
    Random random(seed, 2);
    const auto count = static_cast<std::size_t>(n);
    std::vector<glm::vec2> points;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const auto jitter = [&](int i) {
                return i == 0 || i == n - 1 ? 0.0 : 0.4 * (random.next() - 0.5);
            };
            points.emplace_back((x + jitter(x)) / (n - 1), (y + jitter(y)) / (n - 1));
        }
    }
    std::vector<Triangle> triangles;
    for (std::size_t y = 0; y + 1 < count; ++y) {
        for (std::size_t x = 0; x + 1 < count; ++x) {
            const std::size_t i = y * count + x;
            triangles.push_back({points[i], points[i + 1], points[i + count]});
            triangles.push_back({points[i + 1], points[i + count + 1], points[i + count]});
        }
    }
    return triangles;
}

/// Mean over triangles from the mean over each.
Spectrum mean_of_all(const Texture& texture, const std::vector<Triangle>& triangles) {
    SpectrumSum sum(0.0);
    double whole = 0.0;
    for (const Triangle& t : triangles) {
        sum += area(t) * SpectrumSum(texture.mean_over(t));
        whole += area(t);
    }
    return Spectrum(sum / whole);
}

/// Mean of `at` over the centres of n^2 small triangles alike.
Spectrum sampled_mean(const Texture& texture, const Triangle& t, int n) {
    SpectrumSum sum(0.0);
    const auto add = [&](double b1, double b2) {
        const glm::dvec2 uv =
            (1.0 - b1 - b2) * glm::dvec2(t[0]) + b1 * glm::dvec2(t[1]) + b2 * glm::dvec2(t[2]);
        sum += SpectrumSum(texture.at(glm::vec2(uv)));
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            add((i + 1.0 / 3.0) / n, (j + 1.0 / 3.0) / n);
            if (i + j + 1 < n) add((i + 2.0 / 3.0) / n, (j + 2.0 / 3.0) / n);
        }
    }
    return Spectrum(sum / (static_cast<double>(n) * n));
}

TEST(Texture, IsItsTexelsAtTheirCentres) {
    const Texture texture = noise(5, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x)
            // A centre is off by the rounding of uv, at most 2^-23 of 5 texels.
            expect_near(texture.at({(static_cast<float>(x) + 0.5f) / 5.0f,
                                    (static_cast<float>(y) + 0.5f) / 3.0f}),
                        texture.texels[static_cast<std::size_t>(5 * y + x)], 5 * 0x1p-22f);
}

TEST(Texture, BilinearSamplingReproducesALinearRamp) {
    const Texture texture = ramp(16);
    Random random(1, 1);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec2 uv(1.0 / 32 + random.next() * 30 / 32, 1.0 / 32 + random.next() * 30 / 32);
        expect_near(texture.at(uv), {uv.x, uv.y, 0.25f}, 4 * 0x1p-23f);
    }
    EXPECT_EQ(texture.at({-3.0f, 0.5f}).x, 1.0f / 32);
    EXPECT_EQ(texture.at({7.0f, 0.5f}).x, 31.0f / 32);
}

TEST(Texture, Wraps) {
    const float e = 4 * 0x1p-20f;  // rounding of uv near 4, times texels
    const auto texel = [](int x, int y) {
        return Spectrum(static_cast<float>(x) / 8.0f, static_cast<float>(y) / 8.0f, 1.0f);
    };
    const Texture repeat = image(4, 4, texel);
    const Texture mirrored = image(4, 4, texel, Wrap::mirrored);
    for (const glm::vec2 uv : {glm::vec2(0.3f, 0.8f), {0.01f, 0.02f}, {0.99f, 0.5f}}) {
        expect_near(repeat.at(uv + glm::vec2(3, -2)), repeat.at(uv), e);
        expect_near(mirrored.at(uv + glm::vec2(2, -4)), mirrored.at(uv), e);
        expect_near(mirrored.at({-uv.x, 2.0f - uv.y}), mirrored.at(uv), e);
    }
    // Half-way from the last texel to the first, and from the last to itself.
    EXPECT_FLOAT_EQ(repeat.at({1.0f, 0.125f}).x, (0.0f + 3.0f) / 16.0f);
    EXPECT_FLOAT_EQ(mirrored.at({1.0f, 0.125f}).x, 3.0f / 8.0f);
}

TEST(Texture, IsFiniteHoweverFarAway) {
    for (const Wrap wrap : all_wraps) {
        Texture texture = noise(8, 8, wrap);
        texture.build_levels();
        for (const float far : {1e6f, -1e20f, 3e38f}) {
            EXPECT_TRUE(is_finite(texture.at({far, -far})));
            const Spectrum mean =
                texture.mean_over({glm::vec2(-far, 0.0f), {far, 0.3f * far}, {0.0f, far}});
            EXPECT_TRUE(is_finite(mean));
            if (wrap != Wrap::clamp) expect_near(mean, texture.mean(), 1e-6f);
        }
    }
}

TEST(Texture, MeanOfALinearRampIsItsValueAtTheCentroid) {
    const Texture texture = ramp(32);
    Random random(3, 1);
    const auto within = [&] { return static_cast<float>(1.0 / 64 + random.next() * 62 / 64); };
    for (int i = 0; i < 200; ++i) {
        Triangle t;
        for (glm::vec2& p : t) p = {within(), within()};
        const glm::vec2 centroid = (t[0] + t[1] + t[2]) / 3.0f;
        expect_near(texture.mean_over(t), {centroid.x, centroid.y, 0.25f}, 8 * 0x1p-23f);
    }
}

TEST(Texture, MeanOverATriangleSmallerThanATexelIsItsValueThere) {
    const Texture texture = noise(16, 16);
    Random random(4, 1);
    for (int i = 0; i < 100; ++i) {
        const glm::vec2 p(random.next(), random.next());
        // 1e-4 of a texel wide; no two texels differ by more than 1.
        const float size = 1e-4f / 16;
        expect_near(texture.mean_over({p, p + glm::vec2(size, 0), p + glm::vec2(0, size)}),
                    texture.at(p), 3e-4f);
    }
}

TEST(Texture, MeanOverATriangleWithoutAreaIsThatOfItsLongestEdge) {
    const Texture texture = ramp(16);
    const glm::vec2 p(0.3f, 0.7f), q(0.5f, 0.2f);
    expect_near(texture.mean_over({p, p, p}), {0.3f, 0.7f, 0.25f}, 1e-6f);
    expect_near(texture.mean_over({p, 0.5f * (p + q), q}), {0.4f, 0.45f, 0.25f}, 1e-6f);
}

TEST(Texture, MeanIsThatOfManySamples) {
    for (const Wrap wrap : all_wraps) {
        const Texture texture = noise(6, 5, wrap);
        Random random(5, static_cast<std::uint64_t>(wrap));
        for (int i = 0; i < 20; ++i) {
            Triangle t;
            for (glm::vec2& p : t) p = glm::vec2(random.next(), random.next()) * 4.0f - 1.5f;
            // A sample stands for a triangle up to 4 sqrt(2) * 6 / 512 = 0.07 texels wide, over
            // which the image changes by less than 0.14; to first order that cancels.
            expect_near(texture.mean_over(t), sampled_mean(texture, t, 512), 1e-3f);
        }
    }
}

TEST(Texture, MeanOfACheckerboard) {
    for (const int n : {2, 8, 64, 512, 2048}) {
        Texture board = checkerboard(n);
        board.build_levels();
        EXPECT_NEAR(mean_of_all(board, tiling(2, 1)).x, 0.5f, 1e-6f) << n;
        if (n <= 64) {
            EXPECT_NEAR(mean_of_all(board, tiling(7, 2)).x, 0.5f, 1e-6f) << n;
        }
    }
}

TEST(Texture, MeanOfAStripeInClosedForm) {
    // Columns 0 0 1 1 over the triangle u + v <= 1, which at u is 1 - u wide. The value rises from
    // 0 to 1 between the texel centres 3/8 and 5/8 and, as the image repeats, falls from 1 at 7/8
    // to 0 at 1/8.
    const Texture texture = image(4, 1, [](int x, int) { return Spectrum(x < 2 ? 0.0f : 1.0f); });
    // Integral of the value over u with weight 1 - u, piece by piece.
    const auto piece = [](double u0, double u1, double f0, double f1) {
        const double h = u1 - u0, w0 = 1 - u0, w1 = 1 - u1;
        return h / 6.0 * (2 * f0 * w0 + f0 * w1 + f1 * w0 + 2 * f1 * w1);
    };
    const double integral = piece(0, 0.125, 0.5, 0) + piece(0.375, 0.625, 0, 1) +
                            piece(0.625, 0.875, 1, 1) + piece(0.875, 1, 1, 0.5);
    EXPECT_NEAR(texture.mean_over({glm::vec2(0, 0), {1, 0}, {0, 1}}).x, integral / 0.5, 1e-6);
}

TEST(Texture, TrianglesThatTileTheImageShareOutItsMean) {
    for (const Wrap wrap : all_wraps) {
        for (const auto& [width, height] : {std::pair(1, 1), {2, 2}, {7, 5}, {64, 64}, {100, 3}}) {
            const Texture texture = noise(width, height, wrap);
            for (const int n : {2, 3, 10, 40})
                // Corners are rounded to 2^-24, values too.
                expect_near(mean_of_all(texture, tiling(n, 3)), texture.mean(), 1e-6f);
        }
    }
}

TEST(Texture, LargeTrianglesShareOutItsMeanOnOneLevel) {
    for (const auto& [width, height] : {std::pair(512, 512), {777, 300}, {1, 20000}}) {
        Texture texture = noise(width, height);
        texture.build_levels();
        expect_near(mean_of_all(texture, tiling(2, 1)), texture.mean(), 1e-6f);
    }
}

/// Independent errors of at most 1, with a variance below 1/3, of the texels of a level along an
/// outline; five standard deviations. All lengths in texels.
float five_deviations(double outline, double texel_size, double area) {
    return static_cast<float>(5.0 * std::sqrt(2.0 * outline * texel_size / 3.0) / area);
}

TEST(Texture, TrianglesOnDifferentLevelsShareOutItsMeanAlmost) {
    Texture texture = noise(1024, 1024);
    texture.build_levels();
    for (const float at : {0.5f, 0.9f, 0.99f}) {
        const glm::vec2 apex(at, at);
        const std::array<glm::vec2, 4> corner{glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}};
        std::vector<Triangle> fan;
        for (std::size_t i = 0; i < 4; ++i) fan.push_back({corner[i], corner[(i + 1) % 4], apex});
        // The largest has half of 2^20 texels and goes to texels of 16; the outlines are the square
        // and twice its diagonals.
        const double outline = (4.0 + 4.0 * std::sqrt(2.0)) * 1024;
        expect_near(mean_of_all(texture, fan), texture.mean(),
                    five_deviations(outline, 16.0, 0x1p20));
    }
}

TEST(Texture, LevelsCostLittlePrecision) {
    const Texture exact = noise(512, 512);
    Texture texture = exact;
    texture.build_levels();
    Random random(6, 1);
    for (int i = 0; i < 50; ++i) {
        Triangle t;
        for (glm::vec2& p : t) p = glm::vec2(random.next(), random.next());
        const double texels = area(t) * 512 * 512;
        if (texels < 2000) continue;
        double perimeter = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
            perimeter += 512 * glm::distance(glm::dvec2(t[k]), glm::dvec2(t[(k + 1) % 3]));
        // The first level with at most 4096 cells: texels at most twice as wide as would just do.
        const double texel_size = std::max(1.0, 2.0 * std::sqrt(texels / 2048.0));
        expect_near(texture.mean_over(t), exact.mean_over(t),
                    five_deviations(perimeter, texel_size, texels));
    }
}

TEST(Texture, EveryLevelHasTheMeanOfTheImage) {
    for (const auto& [width, height] :
         {std::pair(1, 1), {2, 2}, {3, 3}, {5, 8}, {31, 17}, {64, 1}, {255, 257}}) {
        Texture texture = noise(width, height);
        const Spectrum mean = texture.mean();
        texture.build_levels();
        for (const Texture::Level& level : texture.levels) {
            SpectrumSum sum(0.0);
            for (const Spectrum& texel : level.texels) sum += SpectrumSum(texel);
            expect_near(Spectrum(sum / double(level.texels.size())), mean, 1e-6f);
        }
        if (width * height > 1) {
            EXPECT_EQ(texture.levels.back().texels.size(), 1u);
        }
        expect_near(texture.mean(), mean, 1e-6f);
    }
}

TEST(Texture, MeansStayWithinTheRangeOfTheTexels) {
    Texture texture = image(33, 33, [](int x, int) { return Spectrum(x < 30 ? 0.0f : 0.99f); });
    texture.build_levels();
    for (const int n : {2, 5, 30, 150}) {
        for (const Triangle& t : tiling(n, 8)) {
            const Spectrum mean = texture.mean_over(t);
            EXPECT_GE(mean.x, 0.0f);
            EXPECT_LE(mean.x, 0.99f);
        }
    }
}

}  // namespace

}  // namespace transillum
