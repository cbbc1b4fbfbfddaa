// Filling a tile: drawing its triangles, and sorting what was drawn by pixel and by depth.
#include "visibility/transillumination_tile.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace transillum {

namespace {

/// A fragment keeps the upper 31 of the 63 bits of depth.
constexpr std::uint64_t depth_bits = 0xffffffff00000000u;
/// While they are drawn, they have the upper 51: steep triangles need the room above.
constexpr int depth_shift = 12;
/// Fragments that are nearer to each other are ordered by their planes.
constexpr Fragment near = std::uint64_t{1} << (32 + 13);
/// Planes of triangles that meet at an edge differ by this much there.
constexpr double depth_rounding = 0x1p24;

/// Lists are short, and nearly in order where triangles are drawn along a surface: insertion sort.
/// Networks without branches took a third longer. \returns the least distance of two, of one or
/// none the largest number
[[gnu::always_inline]] inline Fragment sort_list(Fragment* begin, Fragment* end) {
    for (Fragment* i = begin + 1; i < end; ++i) {
        const Fragment f = *i;
        Fragment* j = i;
        for (; j > begin && j[-1] > f; --j) *j = j[-1];
        *j = f;
    }
    Fragment nearest = ~Fragment{0};
    for (const Fragment* i = begin + 1; i < end; ++i) nearest = std::min(nearest, i[0] - i[-1]);
    return nearest;
}

using Keys = std::uint64_t __attribute__((vector_size(32), aligned(8), may_alias));
using Pixels = std::uint16_t __attribute__((vector_size(16), aligned(2), may_alias));
using Lengths = std::uint32_t __attribute__((vector_size(32), aligned(4), may_alias));

/// Lower halves of the fragments of a block.
struct BlockLeaves {
    Keys first, second;
};

/// Of a root that is one leaf.
class OneLeaf {
public:
    explicit OneLeaf(std::uint64_t low) : low_(low) {}
    void begin_span(int, int) {}
    [[gnu::always_inline]] BlockLeaves next_block() const { return {Keys{} + low_, Keys{} + low_}; }

private:
    std::uint64_t low_;
};

/// \param z of the first pixel, in steps of 2^-depth_fraction of those that are kept
[[gnu::always_inline]] inline void store_keys(Fragment* out, std::uint64_t z, std::uint64_t step,
                                              const BlockLeaves& leaves) {
    const Keys first = z + step * Keys{0, 1, 2, 3};
    const Keys second = first + 4 * step;
    *reinterpret_cast<Keys*>(out) = ((first << depth_shift) & depth_bits) | leaves.first;
    *reinterpret_cast<Keys*>(out + 4) = ((second << depth_shift) & depth_bits) | leaves.second;
}

[[gnu::always_inline]] inline void store_pixels(std::uint16_t* pixel, int at) {
    *reinterpret_cast<Pixels*>(pixel) =
        static_cast<std::uint16_t>(at) + Pixels{0, 1, 2, 3, 4, 5, 6, 7};
}

/// One more for the first `length`.
[[gnu::always_inline]] inline void add_lengths(std::uint32_t* lengths, int length) {
    using Signed = std::int32_t __attribute__((vector_size(32)));
    const Signed is_in = Signed{0, 1, 2, 3, 4, 5, 6, 7} < length;  // -1 where it is
    Lengths& all = *reinterpret_cast<Lengths*>(lengths);
    all -= reinterpret_cast<const Lengths&>(is_in);
}

}  // namespace

/// A triangle's depth in whole numbers, which wrap around: beside it they may be out of range.
struct TransilluminationBuffer::DepthRamp {
    std::uint64_t origin = 0, step = 0, row_step = 0;
    bool is_steep = false;

    DepthRamp(const Plane& depth, const TileRect& rect) {
        constexpr double scale = 1.0 / (std::uint64_t{1} << depth_shift);
        // Spans of what is steeper than that are one pixel long.
        constexpr double steepest = 0x1p55;
        is_steep = !(std::max(std::abs(depth.dx), std::abs(depth.dy)) * scale < steepest);
        if (is_steep) return;
        origin = to_whole(depth.at(rect.x0, rect.y0) * scale);
        step = to_whole(depth.dx * scale);
        row_step = to_whole(depth.dy * scale);
    }
    [[gnu::always_inline]] std::uint64_t at(int x, int y, const TileRect& rect,
                                            const Plane& depth) const {
        if (is_steep) [[unlikely]]
            return static_cast<std::uint64_t>(std::clamp(depth.at(x, y), 0.0, 0x1p63)) >>
                   depth_shift;
        return origin + step * static_cast<std::uint64_t>(x - rect.x0) +
               row_step * static_cast<std::uint64_t>(y - rect.y0);
    }

private:
    static std::uint64_t to_whole(double x) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
    }
};

/// Of a root with many leaves: what each pixel's barycentric coordinates say. Inlined, so that it
/// is compiled for the target of each of the callers' versions.
class TransilluminationBuffer::LeavesAlong {
public:
    /// \param cells table of a mixed root, or none
    LeavesAlong(std::uint64_t low, int level, const std::uint32_t* cells,
                const std::array<Plane, 2>& barycentric)
        : low_(low),
          level_(level),
          cells_(cells),
          barycentric_(barycentric),
          ds_(static_cast<float>(barycentric[0].dx)),
          dt_(static_cast<float>(barycentric[1].dx)) {}
    [[gnu::always_inline]] void begin_span(int x, int y) {
        s_ = static_cast<float>(barycentric_[0].at(x, y));
        t_ = static_cast<float>(barycentric_[1].at(x, y));
    }
    [[gnu::always_inline]] BlockLeaves next_block() {
        std::array<std::uint32_t, block> leaf;
        for (int i = 0; i < block; ++i)
            leaf[i] = leaf_in_root(level_, s_ + ds_ * static_cast<float>(i),
                                   t_ + dt_ * static_cast<float>(i));
        if (cells_ != nullptr)
            for (std::uint32_t& l : leaf) l = cells_[l];
        s_ += block * ds_;
        t_ += block * dt_;
        return {low_ + Keys{leaf[0], leaf[1], leaf[2], leaf[3]},
                low_ + Keys{leaf[4], leaf[5], leaf[6], leaf[7]}};
    }

private:
    std::uint64_t low_;
    int level_;
    const std::uint32_t* cells_;
    std::array<Plane, 2> barycentric_;
    float ds_, dt_, s_ = 0.0f, t_ = 0.0f;
};

/// Through the vertices in the order of their numbers: triangles on the same three vertices then
/// have the same depths to the last bit.
TransilluminationBuffer::Plane TransilluminationBuffer::depth_plane(std::uint32_t root) const {
    const auto& v = mesh_.triangles[root].vertices;
    const auto [low, high] = std::minmax(v[0], v[1]);
    const std::uint32_t least = std::min(low, v[2]), most = std::max(high, v[2]);
    const std::uint32_t middle = std::max(low, std::min(high, v[2]));
    const ProjectedVertex &a = projected_[least], &b = projected_[middle], &c = projected_[most];
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double scale = fixed_unit_ / (bx * cy - cx * by);
    const double zb = b.depth - a.depth, zc = c.depth - a.depth;
    return {a.x / fixed_unit_, a.y / fixed_unit_, a.depth, (zb * cy - zc * by) * scale,
            (zc * bx - zb * cx) * scale};
}

/// Barycentric coordinates of the second and third vertex, about the first.
std::array<TransilluminationBuffer::Plane, 2> TransilluminationBuffer::barycentric_planes(
    const std::array<FixedPoint, 3>& v, std::int64_t twice_area) const {
    const double scale = fixed_unit_ / static_cast<double>(twice_area);
    const double x = v[0].x / fixed_unit_, y = v[0].y / fixed_unit_;
    return {Plane{x, y, 0.0, (v[2].y - v[0].y) * scale, (v[0].x - v[2].x) * scale},
            Plane{x, y, 0.0, (v[0].y - v[1].y) * scale, (v[1].x - v[0].x) * scale}};
}

/// Do two triangles lie in one plane, up to the rounding of their vertices?
bool TransilluminationBuffer::are_coplanar(std::uint32_t root_a, std::uint32_t root_b) const {
    const glm::dvec3 normal = normal_of(mesh_, root_a);
    const glm::dvec3& point = mesh_.positions[mesh_.triangles[root_a].vertices[0]];
    for (const std::uint32_t v : mesh_.triangles[root_b].vertices)
        if (std::abs(glm::dot(normal, mesh_.positions[v] - point)) > plane_tolerance_) return false;
    return true;
}

/// The order of two fragments whose 31 bits of depth all but agree. Vertices were moved within the
/// window, not in depth, so the depths of coinciding surfaces differ a little: there their keys
/// decide, elsewhere their planes do. Planes that meet right at the pixel's centre, as on the
/// outline of whatever is closed, part a little beside it: where the top-left rule takes it to be.
bool TransilluminationBuffer::is_behind(Fragment a, Fragment b, int x, int y) const {
    const std::uint32_t root_a = patches_.root_of_leaf[leaf_of(a)],
                        root_b = patches_.root_of_leaf[leaf_of(b)];
    const Plane plane_a = depth_plane(root_a), plane_b = depth_plane(root_b);
    const double distance = plane_a.at(x, y) - plane_b.at(x, y);
    if (!are_coplanar(root_a, root_b)) {
        if (std::abs(distance) > depth_rounding) return distance > 0.0;
        for (const double slope : {plane_a.dx - plane_b.dx, plane_a.dy - plane_b.dy})
            if (std::abs(slope) > depth_rounding) return slope > 0.0;
    }
    return static_cast<std::uint32_t>(a) > static_cast<std::uint32_t>(b);
}

/// Puts what is too near for its 31 bits of depth in order.
void TransilluminationBuffer::order_near(Fragment* begin, Fragment* end, int x, int y) const {
    for (Fragment* i = begin + 1; i < end; ++i)
        for (Fragment* j = i; j > begin; --j) {
            const Fragment gap = j[0] > j[-1] ? j[0] - j[-1] : j[-1] - j[0];
            if (gap >= near || !is_behind(j[-1], j[0], x, y)) break;
            std::swap(j[-1], j[0]);
        }
}

// Without fused multiplication both versions give the same bits.
#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target_clones("avx2", "default")))
#endif
void TransilluminationBuffer::draw(std::uint32_t root, const TileRect& rect, Scratch& scratch) const {
    const auto& vertices = mesh_.triangles[root].vertices;
    std::array<const ProjectedVertex*, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = &projected_[vertices[i]];
    std::array<FixedPoint, 3> fixed{{{p[0]->x, p[0]->y}, {p[1]->x, p[1]->y}, {p[2]->x, p[2]->y}}};
    const std::int64_t area = twice_area(fixed[0], fixed[1], fixed[2]);
    if (area == 0) return;

    const Plane depth = depth_plane(root);
    const DepthRamp z_ramp(depth, rect);

    // The window's axes and the direction are right-handed: a positive area is seen from ahead.
    const bool from_ahead = area > 0;
    const std::uint64_t facing = from_ahead ? 0x80000000u : 0u;
    const RootPatches& patches = patches_.roots[root];
    const std::array<FixedPoint, 3> turning{fixed[0], fixed[from_ahead ? 1 : 2],
                                            fixed[from_ahead ? 2 : 1]};
    const std::uint64_t low = facing | patches.first_leaf;
    scratch.reserve();
    Fragment* out = scratch.drawn.data() + scratch.count;
    std::uint16_t* pixel = scratch.pixel.data() + scratch.count;
    std::uint32_t* const lengths = scratch.first.data() + 1;
    const int width = rect.x1 - rect.x0;
    const auto draw_spans = [&](auto leaves) __attribute__((always_inline)) {
        const auto draw_span = [&](std::int32_t y, std::int32_t x0, std::int32_t x1)
            __attribute__((always_inline)) {
            int at = (y - rect.y0) * width + (x0 - rect.x0);
            int length = x1 - x0;
            std::uint64_t z = z_ramp.at(x0, y, rect, depth);
            leaves.begin_span(x0, y);
            // Whole blocks, of which the next span overwrites what is too much, and always one:
            // short spans would mispredict a loop's end.
            do {
                store_keys(out, z, z_ramp.step, leaves.next_block());
                store_pixels(pixel, at);
                add_lengths(lengths + at, length);
                const int taken = std::clamp(length, 0, block);
                out += taken;
                pixel += taken;
                at += block;
                z += block * z_ramp.step;
                length -= block;
            } while (length > 0);
        };
        scan_convert(turning, sub_pixel_bits_, rect, draw_span);
    };
    if (patches.level == 0)
        draw_spans(OneLeaf(low));
    else
        draw_spans(LeavesAlong(low, patches.level,
                               patches.mixed == RootPatches::uniform
                                   ? nullptr
                                   : patches_.mixed_roots[patches.mixed].cells.data(),
                               barycentric_planes(fixed, area)));
    scratch.count = static_cast<std::size_t>(out - scratch.drawn.data());
}

void TransilluminationBuffer::fill_tile(int tile, Scratch& scratch) const {
    const int x0 = tile % tiles_x_ * tile_size, y0 = tile / tiles_x_ * tile_size;
    scratch.rect = {x0, y0, std::min(x0 + tile_size, width_), std::min(y0 + tile_size, height_)};
    const int pixels = (scratch.rect.x1 - x0) * (scratch.rect.y1 - y0);
    std::fill_n(scratch.first.begin(), pixels + 1, 0u);
    scratch.count = 0;
    StageClock clock;
    for (const Bins& bins : bins_)
        for (const std::uint32_t root : bins[tile]) draw(root, scratch.rect, scratch);
    clock.lap(scratch.seconds.rasterize);
    if (scratch.count == 0) return;

    // Counting sort by pixel. While filling, first[i] runs from the start of list i to its end,
    // which is the start of list i + 1: shifting by one restores it.
    auto& first = scratch.first;
    std::partial_sum(first.begin(), first.begin() + pixels + 1, first.begin());
    if (scratch.sorted.size() < scratch.count) scratch.sorted.resize(scratch.drawn.size());
    Fragment* const sorted = scratch.sorted.data();
    const Fragment* const drawn = scratch.drawn.data();
    const std::uint16_t* const pixel = scratch.pixel.data();
    std::uint32_t* const place = first.data();
    for (std::size_t i = 0, count = scratch.count; i < count; ++i)
        sorted[place[pixel[i]]++] = drawn[i];
    std::copy_backward(first.begin(), first.begin() + pixels, first.begin() + pixels + 1);
    first[0] = 0;
    const int width = scratch.rect.x1 - x0;
    for (int i = 0; i < pixels; ++i) {
        Fragment* const begin = sorted + first[i];
        Fragment* const end = sorted + first[i + 1];
        if (sort_list(begin, end) < near) order_near(begin, end, x0 + i % width, y0 + i / width);
    }
    clock.lap(scratch.seconds.sort);
}

}  // namespace transillum
