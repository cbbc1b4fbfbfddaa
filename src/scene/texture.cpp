#include <transillum/scene/texture.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace transillum {

namespace {

using Wrap = Texture::Wrap;
using Corners = std::array<glm::dvec2, 3>;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Cells a triangle may cover on the level it is integrated on.
constexpr double most_cells = 4096.0;
/// More than any image has: beyond, a triangle repeats it so often that its mean will do.
constexpr double most_cells_without_levels = 0x1p28;

std::int64_t modulo(std::int64_t i, std::int64_t n) {
    const std::int64_t rest = i % n;
    return rest < 0 ? rest + n : rest;
}

std::int64_t wrapped(std::int64_t i, std::int64_t n, Wrap wrap) {
    if (i >= 0 && i < n) return i;
    if (wrap == Wrap::clamp) return std::clamp<std::int64_t>(i, 0, n - 1);
    if (wrap == Wrap::repeat) return modulo(i, n);
    const std::int64_t within = modulo(i, 2 * n);
    return within < n ? within : 2 * n - 1 - within;
}

/// Moves a coordinate by whole periods, or onto the edge, so that it lies near the image.
double reduced(double u, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp(u, 0.0, 1.0);
    const double period = wrap == Wrap::repeat ? 1.0 : 2.0;
    return u - period * std::floor(u / period);
}

/// An image whose texel centres are the integers.
struct Grid {
    int width, height;
    const Spectrum* texels;
    Wrap wrap_u, wrap_v;

    [[nodiscard]] const Spectrum* row(std::int64_t j) const {
        return texels + wrapped(j, height, wrap_v) * width;
    }
    [[nodiscard]] std::int64_t column(std::int64_t i) const { return wrapped(i, width, wrap_u); }
};

/// The cells between texel centres along one axis; cell k is [k, k + 1]. Beyond a clamped edge the
/// image is constant, and one endless cell holds all of that.
struct CellRange {
    std::int64_t first, last;           ///< cells between a lowest and a highest coordinate
    std::int64_t lower_end, upper_end;  ///< numbers of the endless cells

    CellRange(double low, double high, int size, Wrap wrap)
        : lower_end(std::numeric_limits<std::int64_t>::min()),
          upper_end(std::numeric_limits<std::int64_t>::max()) {
        if (wrap == Wrap::clamp) {
            lower_end = -1;
            upper_end = size - 1;
            low = std::clamp(low, -1.0, static_cast<double>(upper_end));
            high = std::clamp(high, -1.0, static_cast<double>(upper_end));
        }
        first = static_cast<std::int64_t>(std::floor(low));
        last = static_cast<std::int64_t>(std::floor(high));
    }
    [[nodiscard]] double begin(std::int64_t k) const {
        return k <= lower_end ? -infinity : static_cast<double>(k);
    }
    [[nodiscard]] double end(std::int64_t k) const {
        return k >= upper_end ? infinity : static_cast<double>(k + 1);
    }
    [[nodiscard]] double count() const { return static_cast<double>(last - first + 1); }
};

/// A triangle cut by up to four lines.
struct Convex {
    std::array<glm::dvec2, 7> points;
    int count = 0;

    void add(const glm::dvec2& p) { points[static_cast<std::size_t>(count++)] = p; }
    [[nodiscard]] const glm::dvec2& operator[](int i) const {
        return points[static_cast<std::size_t>(i)];
    }
};

/// What lies on the side of `axis` = `bound` where sign * (coordinate - bound) >= 0.
Convex clip(const Convex& polygon, int axis, double bound, double sign) {
    if (std::isinf(bound)) return polygon;
    Convex kept;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec2& p = polygon[i];
        const glm::dvec2& q = polygon[(i + 1) % polygon.count];
        const double at_p = sign * (p[axis] - bound), at_q = sign * (q[axis] - bound);
        if (at_p >= 0.0) kept.add(p);
        if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0)) {
            glm::dvec2 crossing = p + (q - p) * (at_p / (at_p - at_q));
            crossing[axis] = bound;
            kept.add(crossing);
        }
    }
    return kept;
}

std::pair<double, double> extent(const Convex& polygon, int axis) {
    double low = infinity, high = -infinity;
    for (int i = 0; i < polygon.count; ++i) {
        low = std::min(low, polygon[i][axis]);
        high = std::max(high, polygon[i][axis]);
    }
    return {low, high};
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Integral of the bilinear interpolant over parts of cells.
class Integral {
public:
    explicit Integral(const Grid& grid) : grid_(grid) {}

    void add_triangle(const Convex& triangle) {
        const auto [low, high] = extent(triangle, 1);
        const CellRange rows(low, high, grid_.height, grid_.wrap_v);
        for (std::int64_t j = rows.first; j <= rows.last; ++j)
            add_strip(clip(clip(triangle, 1, rows.begin(j), 1.0), 1, rows.end(j), -1.0), rows, j);
    }
    [[nodiscard]] double weight() const { return weight_; }
    [[nodiscard]] Spectrum mean() const { return Spectrum(sum_ / weight_); }

private:
    /// Cells [first, second) of row j that a convex part of it covers whole.
    static std::pair<std::int64_t, std::int64_t> whole_cells(const Convex& strip,
                                                             const CellRange& rows, std::int64_t j,
                                                             const CellRange& columns) {
        std::array<double, 2> low{infinity, infinity}, high{-infinity, -infinity};
        for (int i = 0; i < strip.count; ++i) {
            for (const std::size_t end : {0u, 1u}) {
                if (strip[i].y != (end == 0 ? rows.begin(j) : rows.end(j))) continue;
                low[end] = std::min(low[end], strip[i].x);
                high[end] = std::max(high[end], strip[i].x);
            }
        }
        const double left = std::ceil(std::max(low[0], low[1]));
        const double right = std::floor(std::min(high[0], high[1]));
        if (!(left < right)) return {0, 0};
        return {std::max(static_cast<std::int64_t>(left), columns.lower_end + 1),
                std::min(static_cast<std::int64_t>(right), columns.upper_end)};
    }

    void add_strip(const Convex& strip, const CellRange& rows, std::int64_t j) {
        if (strip.count < 3) return;
        const auto [low, high] = extent(strip, 0);
        const CellRange columns(low, high, grid_.width, grid_.wrap_u);
        const auto [whole, whole_end] = whole_cells(strip, rows, j, columns);
        for (std::int64_t i = columns.first; i <= columns.last; ++i) {
            if (i == whole && whole < whole_end) {
                add_whole_cells(whole, whole_end, j);
                i = whole_end - 1;
            } else {
                add_part(clip(clip(strip, 0, columns.begin(i), 1.0), 0, columns.end(i), -1.0), i,
                         j);
            }
        }
    }

    void add_whole_cells(std::int64_t first, std::int64_t end, std::int64_t j) {
        const Spectrum* upper = grid_.row(j);
        const Spectrum* lower = grid_.row(j + 1);
        const auto column = [&](std::int64_t i) {
            const std::int64_t at = grid_.column(i);
            return SpectrumSum(upper[at]) + SpectrumSum(lower[at]);
        };
        // Inner columns belong to two cells.
        SpectrumSum columns = 0.5 * (column(first) + column(end));
        for (std::int64_t i = first + 1; i < end; ++i) columns += column(i);
        sum_ += 0.5 * columns;
        weight_ += static_cast<double>(end - first);
    }

    void add_part(const Convex& part, std::int64_t i, std::int64_t j) {
        if (part.count < 3) return;
        const glm::dvec2 corner(static_cast<double>(i), static_cast<double>(j));
        double area = 0.0, x = 0.0, y = 0.0, xy = 0.0;  // integrals of 1, x, y and xy
        const auto local = [&](int k) { return glm::clamp(part[k] - corner, 0.0, 1.0); };
        const glm::dvec2 a = local(0);
        for (int k = 1; k + 1 < part.count; ++k) {
            const glm::dvec2 b = local(k), c = local(k + 1);
            const double piece = 0.5 * std::abs(cross(part[k] - part[0], part[k + 1] - part[0]));
            const glm::dvec2 sum = a + b + c;
            area += piece;
            x += piece / 3.0 * sum.x;
            y += piece / 3.0 * sum.y;
            xy += piece / 12.0 * (sum.x * sum.y + a.x * a.y + b.x * b.y + c.x * c.y);
        }
        const Spectrum* upper = grid_.row(j);
        const Spectrum* lower = grid_.row(j + 1);
        const std::int64_t left = grid_.column(i), right = grid_.column(i + 1);
        add(upper[left], area - x - y + xy);
        add(upper[right], x - xy);
        add(lower[left], y - xy);
        add(lower[right], xy);
    }

    void add(const Spectrum& texel, double weight) {
        weight = std::max(weight, 0.0);  // rounding must not make the mean leave its texels' range
        sum_ += weight * SpectrumSum(texel);
        weight_ += weight;
    }

    const Grid& grid_;
    SpectrumSum sum_{0.0};
    double weight_ = 0.0;
};

Convex on_grid(const Corners& uv, const Grid& grid) {
    Convex triangle;
    for (const glm::dvec2& p : uv) triangle.add(p * glm::dvec2(grid.width, grid.height) - 0.5);
    return triangle;
}

/// Bound of the number of cells a triangle touches.
double cells_touched(const Convex& t, const Grid& grid) {
    const auto [left, right] = extent(t, 0);
    const auto [top, bottom] = extent(t, 1);
    if (right - left > most_cells_without_levels || bottom - top > most_cells_without_levels) {
        if (grid.wrap_u != Wrap::clamp && right - left > most_cells_without_levels) return infinity;
        if (grid.wrap_v != Wrap::clamp && bottom - top > most_cells_without_levels) return infinity;
    }
    const double in_box = CellRange(left, right, grid.width, grid.wrap_u).count() *
                          CellRange(top, bottom, grid.height, grid.wrap_v).count();
    const double area = 0.5 * std::abs(cross(t[1] - t[0], t[2] - t[0]));
    return std::min(in_box, area + 2.0 * (right - left + bottom - top) + 4.0);
}

/// Moved by whole periods towards the image, where doubles are fine.
Corners near_image(const std::array<glm::vec2, 3>& triangle, const std::array<Wrap, 2>& wrap) {
    Corners moved{triangle[0], triangle[1], triangle[2]};
    for (int axis = 0; axis < 2; ++axis) {
        const Wrap w = wrap[static_cast<std::size_t>(axis)];
        if (w == Wrap::clamp) continue;
        const double move = reduced(moved[0][axis], w) - moved[0][axis];
        for (glm::dvec2& p : moved) p[axis] += move;
    }
    return moved;
}

/// Ends of the longest edge, of a triangle without area.
std::array<glm::dvec2, 2> longest_edge(const Corners& t) {
    std::array<glm::dvec2, 2> ends{t[0], t[1]};
    for (std::size_t i = 1; i < 3; ++i)
        if (glm::distance(t[i], t[(i + 1) % 3]) > glm::distance(ends[0], ends[1]))
            ends = {t[i], t[(i + 1) % 3]};
    return ends;
}

bool has_no_area(const Corners& t) {
    const auto [a, b] = longest_edge(t);
    const glm::dvec2 along = b - a;
    // Thinner ones would be lost in the rounding of their crossings with the cells.
    return std::abs(cross(t[1] - t[0], t[2] - t[0])) <= 1e-9 * glm::dot(along, along);
}

/// A row or a column at half its length, each new value the mean of its share of the old ones.
template <class Get, class Put>
void halve(int size, int half, Get get, Put put) {
    const double share = static_cast<double>(size) / half;
    for (int i = 0; i < half; ++i) {
        const double begin = i * share, end = std::min((i + 1) * share, double(size));
        SpectrumSum sum(0.0);
        for (int k = static_cast<int>(begin); k < end; ++k)
            sum += (std::min(k + 1.0, end) - std::max(double(k), begin)) * SpectrumSum(get(k));
        put(i, Spectrum(sum / (end - begin)));
    }
}

Texture::Level halved(int width, int height, const std::vector<Spectrum>& texels) {
    const int w = std::max(1, width / 2), h = std::max(1, height / 2);
    const auto at = [](int size, int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
               static_cast<std::size_t>(x);
    };
    std::vector<Spectrum> narrow(at(w, 0, height));
    for (int y = 0; y < height; ++y)
        halve(
            width, w, [&](int x) { return texels[at(width, x, y)]; },
            [&](int x, const Spectrum& value) { narrow[at(w, x, y)] = value; });
    Texture::Level level{w, h, std::vector<Spectrum>(at(w, 0, h))};
    for (int x = 0; x < w; ++x)
        halve(
            height, h, [&](int y) { return narrow[at(w, x, y)]; },
            [&](int y, const Spectrum& value) { level.texels[at(w, x, y)] = value; });
    return level;
}

}  // namespace

Spectrum Texture::at(glm::vec2 uv) const {
    const Grid grid{width, height, texels.data(), wrap_u, wrap_v};
    const double x = reduced(uv.x, wrap_u) * width - 0.5, y = reduced(uv.y, wrap_v) * height - 0.5;
    const double i = std::floor(x), j = std::floor(y);
    const Spectrum* upper = grid.row(static_cast<std::int64_t>(j));
    const Spectrum* lower = grid.row(static_cast<std::int64_t>(j) + 1);
    const std::int64_t left = grid.column(static_cast<std::int64_t>(i));
    const std::int64_t right = grid.column(static_cast<std::int64_t>(i) + 1);
    const auto across = static_cast<float>(x - i), down = static_cast<float>(y - j);
    return glm::mix(glm::mix(upper[left], upper[right], across),
                    glm::mix(lower[left], lower[right], across), down);
}

Spectrum Texture::mean_over(const std::array<glm::vec2, 3>& triangle) const {
    const Corners uv = near_image(triangle, {wrap_u, wrap_v});
    if (has_no_area(uv)) {
        constexpr int samples = 16;
        const auto [a, b] = longest_edge(uv);
        SpectrumSum sum(0.0);
        for (int k = 0; k < samples; ++k)
            sum += SpectrumSum(at(glm::vec2(glm::mix(a, b, (k + 0.5) / samples))));
        return Spectrum(sum / double(samples));
    }
    Grid grid{width, height, texels.data(), wrap_u, wrap_v};
    double cells = cells_touched(on_grid(uv, grid), grid);
    for (const Level& level : levels) {
        if (cells <= most_cells) break;
        grid = {level.width, level.height, level.texels.data(), wrap_u, wrap_v};
        cells = cells_touched(on_grid(uv, grid), grid);
    }
    if (cells > (levels.empty() ? most_cells_without_levels : most_cells)) return mean();
    Integral integral(grid);
    integral.add_triangle(on_grid(uv, grid));
    return integral.mean();
}

Spectrum Texture::mean() const {
    if (!levels.empty()) return levels.back().texels[0];
    SpectrumSum sum(0.0);
    for (const Spectrum& texel : texels) sum += SpectrumSum(texel);
    return Spectrum(sum / static_cast<double>(texels.size()));
}

void Texture::build_levels() {
    levels.clear();
    int w = width, h = height;
    const std::vector<Spectrum>* finer = &texels;
    while (w > 1 || h > 1) {
        levels.push_back(halved(w, h, *finer));
        w = levels.back().width;
        h = levels.back().height;
        finer = &levels.back().texels;
    }
}

}  // namespace transillum
