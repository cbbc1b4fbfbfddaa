/// Watertight scan conversion, shared by the transillumination buffer and the hemicube.
///
/// Vertices are snapped to a fraction of a pixel, 1/256 in the largest windows, and edges are
/// evaluated in integers, with the top-left rule: a pixel centre that lies on the common edge of
/// two triangles belongs to exactly one of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

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

/// Where one edge crosses the pixel rows: quotient and remainder of a division, stepped row by row.
/// An edge bounds spans at their start or at their end; which, is not a branch: small triangles
/// would mispredict it.
class EdgeWalk {
public:
    /// No bound within [x_begin, x_end).
    EdgeWalk(std::int32_t x_begin, std::int32_t x_end)
        : quotient_(x_begin), start_mask_(-1), x_end_(x_end), x_begin_(x_begin) {}
    /// Inside is where a * x + b * row + c >= 0, x counted from x_begin; a != 0.
    EdgeWalk(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t x_begin,
             std::int32_t x_end)
        : divisor_(std::abs(a)), start_mask_(a > 0 ? -1 : 0), x_end_(x_end), x_begin_(x_begin) {
        // a > 0: from ceil(-(b row + c) / a) on; a < 0: up to floor((b row + c) / -a).
        const std::int32_t numerator = a > 0 ? a - 1 - c : c - a;
        const std::int32_t step = a > 0 ? -b : b;
        const std::int32_t quotient = floor_div(numerator, divisor_);
        quotient_ = x_begin + quotient;
        remainder_ = numerator - quotient * divisor_;
        step_quotient_ = floor_div(step, divisor_);
        step_remainder_ = step - step_quotient_ * divisor_;
    }
    [[nodiscard]] std::int32_t start() const {
        return (quotient_ & start_mask_) | (x_begin_ & ~start_mask_);
    }
    [[nodiscard]] std::int32_t end() const {
        return (quotient_ & ~start_mask_) | (x_end_ & start_mask_);
    }
    void next_row() {
        quotient_ += step_quotient_;
        remainder_ += step_remainder_ - divisor_;
        const std::int32_t no_carry = remainder_ >> 31;  // -1 or 0
        quotient_ += 1 + no_carry;
        remainder_ += divisor_ & no_carry;
    }

private:
    static std::int32_t floor_div(std::int32_t a, std::int32_t b) {
        return a / b - (a % b < 0 ? 1 : 0);
    }

    std::int32_t divisor_ = 1, quotient_ = 0, remainder_ = 0, step_quotient_ = 0,
                 step_remainder_ = 0;
    std::int32_t start_mask_, x_end_, x_begin_;
};

/// Calls `span(y, x0, x1)` for every row of `rect` where pixel centres [x0, x1) lie in the
/// triangle. \param bits of a pixel; all coordinates are below 2^window_bits.
/// \pre twice_area(v[0], v[1], v[2]) > 0
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
    std::array<EdgeWalk, 3> edges{EdgeWalk(x_begin, x_end), EdgeWalk(x_begin, x_end),
                                  EdgeWalk(x_begin, x_end)};
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
            edges[i] = EdgeWalk(a, b, c32, x_begin, x_end);
        else if (b > 0)
            y_first = y_begin + (b - 1 - c32) / b;
        else
            y_end = y_begin + c32 / -b + 1;
    }
    for (std::int32_t y = y_begin; y < y_end; ++y) {
        const std::int32_t x0 =
            std::max({x_begin, edges[0].start(), edges[1].start(), edges[2].start()});
        const std::int32_t x1 = std::min({x_end, edges[0].end(), edges[1].end(), edges[2].end()});
        if (x0 < x1 && y >= y_first) span(y, x0, x1);
        for (EdgeWalk& e : edges) e.next_row();
    }
}

}  // namespace transillum
