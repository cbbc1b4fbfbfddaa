#include "visibility/scan_convert.h"

#include <transillum/base/sampling.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace transillum {
namespace {

using Triangle = std::array<FixedPoint, 3>;

/// Is the point inside, or on an edge whose left or top side is inside? Directly from the rule.
bool owns(const Triangle& v, std::int64_t x, std::int64_t y) {
    for (int i = 0; i < 3; ++i) {
        const FixedPoint &p = v[i], &q = v[(i + 1) % 3];
        const std::int64_t side =
            std::int64_t{q.x - p.x} * (y - p.y) - std::int64_t{q.y - p.y} * (x - p.x);
        const bool owns_edge = q.y < p.y || (q.y == p.y && q.x > p.x);
        if (side < 0 || (side == 0 && !owns_edge)) return false;
    }
    return true;
}

/// Triangles of all sizes, many with corners on pixel centres or level edges.
Triangle random_triangle(Random& random, int bits) {
    Triangle t;
    const double size = std::ldexp(1.0, bits - 4 + static_cast<int>(14.0 * random.next()));
    const bool whole = random.next() < 0.5;
    for (FixedPoint& p : t) {
        p = {static_cast<std::int32_t>(size * (random.next() - 0.3)),
             static_cast<std::int32_t>(size * (random.next() - 0.3))};
        const int centres = ~((1 << bits) - 1);
        if (whole) p = {p.x & centres, p.y & centres};
    }
    if (random.next() < 0.3) t[1].y = t[0].y;
    return t;
}

class ScanConvert : public testing::TestWithParam<int> {};  // sub-pixel bits

TEST_P(ScanConvert, AgreesWithTheEdgeRule) {
    const int bits = GetParam();
    Random random(6, 1);
    const TileRect rect{10, 20, 74, 84};
    int tried = 0;
    while (tried < 2000) {
        Triangle t = random_triangle(random, bits);
        const std::int64_t area = twice_area(t[0], t[1], t[2]);
        if (area == 0) continue;
        if (area < 0) std::swap(t[1], t[2]);
        ++tried;
        std::vector<int> drawn(64 * 64);
        scan_convert(t, bits, rect, [&](std::int32_t y, std::int32_t x0, std::int32_t x1) {
            for (std::int32_t x = x0; x < x1; ++x) ++drawn.at((y - 20) * 64 + x - 10);
        });
        for (int y = 20; y < 84; ++y)
            for (int x = 10; x < 74; ++x)
                ASSERT_EQ(drawn[(y - 20) * 64 + x - 10], owns(t, x << bits, y << bits) ? 1 : 0)
                    << x << ", " << y;
    }
}

/// Where windows are as large as they may be, edge values must still fit.
TEST_P(ScanConvert, AgreesAtTheEndsOfTheLargestWindow) {
    const int bits = GetParam(), window = 1 << (window_bits - bits);
    const std::int32_t far = (window - 1) << bits;
    const std::vector<Triangle> triangles{{{{0, 0}, {far, 1}, {far - 3, far}}},
                                          {{{0, 5}, {far, 0}, {1, far}}},
                                          {{{0, 0}, {far, far - 1}, {far - 1, far}}},
                                          {{{7, 0}, {far, far}, {0, far - 9}}}};
    for (const Triangle& t : triangles) {
        ASSERT_GT(twice_area(t[0], t[1], t[2]), 0);
        for (const int x0 : {0, window / 2 - 64, window - 64})
            for (const int y0 : {0, window / 2 - 64, window - 64}) {
                std::vector<int> drawn(64 * 64);
                scan_convert(t, bits, {x0, y0, x0 + 64, y0 + 64},
                             [&](std::int32_t y, std::int32_t a, std::int32_t b) {
                                 for (std::int32_t x = a; x < b; ++x)
                                     ++drawn.at((y - y0) * 64 + x - x0);
                             });
                for (int i = 0; i < 64 * 64; ++i)
                    ASSERT_EQ(drawn[i],
                              owns(t, (x0 + i % 64) << bits, (y0 + i / 64) << bits) ? 1 : 0);
            }
    }
}

INSTANTIATE_TEST_SUITE_P(SubPixelBits, ScanConvert, testing::Values(sub_pixel_bits, 11, 15));

}  // namespace
}  // namespace transillum
