/// Watertight scan conversion, shared by the transillumination buffer and the hemicube.
///
/// Vertices are snapped to a fraction of a pixel, 1/256 in the largest windows, and edges are
/// evaluated in integers, with the top-left rule: a pixel centre that lies on the common edge of
/// two triangles belongs to exactly one of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace transillum {

inline constexpr int sub_pixel_bits = 8;
/// Windows have at most this many pixels a side, so that edge values across a tile fit 32 bits.
inline constexpr int max_window = 1 << 14;
/// Smaller windows have room for more sub-pixel bits: as many as this in all.
inline constexpr int window_bits = 14 + sub_pixel_bits;
inline constexpr int tile_size = 64;

/// A vertex in fractions of a pixel, 2^-bits each; pixel centres lie at whole pixels.
struct FixedPoint {
    std::int32_t x = 0, y = 0;
};

/// Twice the signed area, in squares of these fractions.
[[nodiscard]] inline std::int64_t twice_area(const FixedPoint& a, const FixedPoint& b,
                                             const FixedPoint& c) {
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

/// First pixel centre at or after a coordinate.
[[nodiscard]] inline std::int32_t first_centre(std::int32_t fixed, int bits) {
    return (fixed + (1 << bits) - 1) >> bits;
}

/// Pixels [x0, x1) x [y0, y1), at most tile_size a side.
struct TileRect {
    std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Rows whose spans are worked out at once, a lane each.
inline constexpr int rows_at_once = 4;
using RowBounds = double __attribute__((vector_size(8 * rows_at_once)));

/// Where an edge crosses the pixel rows: it bounds spans at their start or at their end; which, is
/// not a branch: small triangles would mispredict it. A bound is a quotient of whole numbers below
/// 2^31, rounded up or down. It is worked out in double: half a step beside the numerator keeps all
/// quotients so far from whole numbers that a product with the reciprocal does.
class EdgeBounds {
public:
    /// Bounds nothing.
    EdgeBounds() = default;
    /// Inside is where a * x + b * row + c >= 0; a != 0.
    EdgeBounds(std::int32_t a, std::int32_t b, std::int32_t c)
        // a > 0: from ceil(-(b row + c) / a) on; a < 0: up to floor((b row + c) / -a).
        : numerator_(static_cast<double>(a - c) - 0.5), step_(b), reciprocal_(1.0 / a) {
        const double way = std::copysign(0.5 * unbounded, static_cast<double>(a));
        at_start_ = way - 0.5 * unbounded;
        at_end_ = way + 0.5 * unbounded;
    }

    /// \param rows those looked at
    [[gnu::always_inline]] void apply(const RowBounds& rows, RowBounds& start,
                                      RowBounds& end) const {
        // What lies between two whole numbers, less a half, is rounded to the lower one.
        constexpr double to_whole = 0x1.8p52;
        const RowBounds quotient = (numerator_ - step_ * rows) * reciprocal_;
        const RowBounds bound = (quotient - 0.5 + to_whole) - to_whole;
        const RowBounds from = bound + at_start_, to = bound + at_end_;
        start = start > from ? start : from;
        end = end < to ? end : to;
    }

private:
    static constexpr double unbounded = 0x1p40;
    double numerator_ = 0.0, step_ = 0.0, reciprocal_ = 0.0;
    double at_start_ = -unbounded, at_end_ = unbounded;
};

/// Calls `span(y, x0, x1)` for every row of `rect` in which pixel centres [x0, x1) lie in the
/// triangle, and for some in which none does: x1 <= x0 there, x0 as far as the rectangle's end.
/// \param bits of a pixel; all coordinates are below 2^window_bits. \pre twice_area(v[0], v[1],
/// v[2]) > 0
template <class Span>
[[gnu::always_inline]] inline void scan_convert(const std::array<FixedPoint, 3>& v, int bits,
                                                const TileRect& rect, Span&& span) {
    const std::int32_t x_begin =
        std::max(rect.x0, first_centre(std::min({v[0].x, v[1].x, v[2].x}), bits));
    const std::int32_t x_end = std::min(rect.x1, (std::max({v[0].x, v[1].x, v[2].x}) >> bits) + 1);
    const std::int32_t y_begin =
        std::max(rect.y0, first_centre(std::min({v[0].y, v[1].y, v[2].y}), bits));
    std::int32_t y_end = std::min(rect.y1, (std::max({v[0].y, v[1].y, v[2].y}) >> bits) + 1);
    if (x_begin >= x_end || y_begin >= y_end) return;

    std::int32_t y_first = y_begin;
    std::array<EdgeBounds, 3> edges;
    const std::int32_t width = x_end - 1 - x_begin;
    const std::int32_t height = y_end - 1 - y_begin;
    for (int i = 0; i < 3; ++i) {
        const FixedPoint& p = v[i];
        const FixedPoint& q = v[i == 2 ? 0 : i + 1];
        // Inside: a x + b y + c >= 0. At pixel centres the edge function changes in steps of
        // 2^bits, so it may be divided by that, rounding down, without changing its sign.
        const std::int32_t a = p.y - q.y;
        const std::int32_t b = q.x - p.x;
        const bool owns_its_points = a > 0 || (a == 0 && b > 0);
        const std::int64_t at_origin =
            -(std::int64_t{a} * p.x + std::int64_t{b} * p.y) - (owns_its_points ? 0 : 1);
        const std::int64_t c =
            (at_origin >> bits) + std::int64_t{a} * x_begin + std::int64_t{b} * y_begin;
        const std::int64_t dx = std::int64_t{a} * width;
        const std::int64_t dy = std::int64_t{b} * height;
        if (c + std::min<std::int64_t>(dx, 0) + std::min<std::int64_t>(dy, 0) >= 0) continue;
        if (c + std::max<std::int64_t>(dx, 0) + std::max<std::int64_t>(dy, 0) < 0) return;
        // The edge crosses this rectangle, so its values here are below 2 * 64 * 2^22.
        const auto c32 = static_cast<std::int32_t>(c);
        if (a != 0)
            edges[i] = EdgeBounds(a, b, c32);
        else if (b > 0)
            y_first = y_begin + (b - 1 - c32) / b;
        else
            y_end = y_begin + c32 / -b + 1;
    }
    using Bounds = std::int32_t __attribute__((vector_size(4 * rows_at_once)));
    const double limit = width + 1;
    RowBounds rows{0.0, 1.0, 2.0, 3.0};
    for (std::int32_t y0 = y_begin; y0 < y_end; y0 += rows_at_once, rows += rows_at_once) {
        RowBounds start{}, end = RowBounds{} + limit;
        for (const EdgeBounds& e : edges) e.apply(rows, start, end);
        start = start < limit ? start : RowBounds{} + limit;
        const Bounds x0 = x_begin + __builtin_convertvector(start, Bounds);
        const Bounds x1 = x_begin + __builtin_convertvector(end, Bounds);
        const std::int32_t first = std::max(y_first - y0, 0);
        const std::int32_t last = std::min(y_end - y0, rows_at_once);
        for (std::int32_t r = first; r < last; ++r) span(y0 + r, x0[r], x1[r]);
    }
}

}  // namespace transillum
