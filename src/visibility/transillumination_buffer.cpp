#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/visibility/transillumination_buffer.h>

#include "visibility/scan_convert.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

namespace transillum {

namespace {

constexpr std::uint32_t triangles_a_bin_set = 1u << 14;
constexpr double fixed_unit = 1 << sub_pixel_bits;
/// Depths are 63-bit integers, of which a fragment keeps the upper 31. The margin takes up rounding.
constexpr double depth_margin = 0x1p40;
/// Planes of triangles that meet at an edge differ by this much there.
constexpr double depth_rounding = 0x1p24;
constexpr std::uint64_t depth_bits = 0xffffffff00000000u;

/// Pixels of a span that are drawn at once.
constexpr int block = 8;

std::array<std::uint32_t, block> leaves_of_block(int level, float s0, float ds, float t0, float dt) {
    std::array<std::uint32_t, block> leaves;
    for (int i = 0; i < block; ++i)
        leaves[i] = leaf_in_root(level, s0 + ds * static_cast<float>(i), t0 + dt * static_cast<float>(i));
    return leaves;
}

struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

Bounds bounds_of(const std::vector<glm::dvec3>& points, const glm::dmat3& axes) {
    Bounds b;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 q = p * axes;
        b.low = glm::min(b.low, q);
        b.high = glm::max(b.high, q);
    }
    return b;
}

}  // namespace

/// A quantity that is linear over the window.
struct TransilluminationBuffer::Plane {
    double x0, y0, value, dx, dy;
    [[nodiscard]] double at(int x, int y) const { return value + dx * (x - x0) + dy * (y - y0); }
};

/// A tile being filled. Fragments are drawn in the triangles' order, then sorted by pixel and by depth.
struct TransilluminationBuffer::Scratch {
    TileRect rect;
    std::vector<Fragment> drawn, sorted;
    std::vector<std::uint16_t> pixel;
    std::vector<std::uint32_t> first = std::vector<std::uint32_t>(tile_size * tile_size + 1 + block);
    std::size_t count = 0;

    /// Makes room for a triangle that covers the tile.
    void reserve() {
        constexpr std::size_t most = tile_size * tile_size + block;
        if (drawn.size() >= count + most) return;
        drawn.resize(2 * drawn.size() + 8 * most);
        pixel.resize(drawn.size());
    }
};

Bundle sample_bundle(std::uint32_t index, std::uint64_t seed) {
    const auto u = [&](int dimension) { return sobol_owen(index, dimension, seed); };
    const glm::dmat3 frame = frame_about(uniform_direction(u(0), u(1)));
    const double turn = 2.0 * std::numbers::pi * u(2);
    const double c = std::cos(turn), s = std::sin(turn);
    return {{c * frame[0] + s * frame[1], c * frame[1] - s * frame[0], frame[2]}, u(3), u(4), static_cast<int>(256.0 * u(5))};
}

double pixel_size_for(const SurfaceMesh& mesh, int resolution) {
    if (resolution < 16 || resolution > 8192)
        throw UsageError("resolution " + std::to_string(resolution) + "; accepted: 16 to 8192 pixels");
    const Bounds b = bounds_of(mesh.positions, glm::dmat3(1.0));
    const glm::dvec3 size = b.high - b.low;
    // The mean width of a box over all directions is half the sum of its edges.
    return (size.x + size.y + size.z) / 2.0 / resolution;
}

TransilluminationBuffer::TransilluminationBuffer(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                                 double pixel_size)
    : mesh_(mesh), patches_(patches), pixel_size_(pixel_size), projected_(mesh.positions.size()) {
    const Bounds b = bounds_of(mesh.positions, glm::dmat3(1.0));
    const double widest = glm::length(b.high - b.low) / pixel_size;
    if (!(pixel_size > 0.0 && widest < max_window - 2))
        throw UsageError("pixel size " + std::to_string(pixel_size) + ": the window would be " +
                         std::to_string(widest) + " pixels wide; accepted: at most " + std::to_string(max_window));
    const glm::dvec3 furthest = glm::max(glm::abs(b.low), glm::abs(b.high));
    plane_tolerance_ = std::max({furthest.x, furthest.y, furthest.z}) * 0x1p-38;
    bins_.resize((mesh.triangles.size() + triangles_a_bin_set - 1) / triangles_a_bin_set);
}

TransilluminationBuffer::~TransilluminationBuffer() = default;

void TransilluminationBuffer::project(const Bundle& bundle, const Workers& workers) {
    constexpr std::size_t grain = 4096;
    std::vector<Bounds> partial((mesh_.positions.size() + grain - 1) / grain);
    workers.for_ranges(partial.size(), 1, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t r = begin; r < end; ++r) {
            Bounds b;
            for (std::size_t i = r * grain; i < std::min((r + 1) * grain, mesh_.positions.size()); ++i) {
                const glm::dvec3 q = mesh_.positions[i] * bundle.frame;
                b.low = glm::min(b.low, q);
                b.high = glm::max(b.high, q);
            }
            partial[r] = b;
        }
    });
    Bounds b;
    for (const Bounds& p : partial) {
        b.low = glm::min(b.low, p.low);
        b.high = glm::max(b.high, p.high);
    }
    const double scale = fixed_unit / pixel_size_;
    const glm::dvec2 shift = glm::dvec2(bundle.offset_x, bundle.offset_y) * fixed_unit - glm::dvec2(b.low) * scale;
    const double range = b.high.z - b.low.z;
    const double depth_scale = range > 0.0 ? (0x1p63 - 2.0 * depth_margin) / range : 0.0;
    width_ = static_cast<int>(std::ceil((b.high.x - b.low.x) / pixel_size_)) + 2;
    height_ = static_cast<int>(std::ceil((b.high.y - b.low.y) / pixel_size_)) + 2;
    tiles_x_ = (width_ + tile_size - 1) / tile_size;
    tiles_y_ = (height_ + tile_size - 1) / tile_size;
    workers.for_ranges(mesh_.positions.size(), grain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::dvec3 q = mesh_.positions[i] * bundle.frame;
            projected_[i] = {static_cast<std::int32_t>(std::lrint(q.x * scale + shift.x)),
                             static_cast<std::int32_t>(std::lrint(q.y * scale + shift.y)),
                             depth_margin + (q.z - b.low.z) * depth_scale};
        }
    });
}

void TransilluminationBuffer::bin(const Workers& workers) {
    const std::size_t tiles = static_cast<std::size_t>(tiles_x_) * tiles_y_;
    workers.for_ranges(bins_.size(), 1, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t set = begin; set < end; ++set) {
            Bins& bins = bins_[set];
            if (bins.size() < tiles) bins.resize(tiles);
            for (auto& bin : bins) bin.clear();
            const std::size_t last = std::min<std::size_t>((set + 1) * triangles_a_bin_set, mesh_.triangles.size());
            for (std::size_t t = set * triangles_a_bin_set; t < last; ++t) {
                const auto& v = mesh_.triangles[t].vertices;
                const ProjectedVertex &a = projected_[v[0]], &b = projected_[v[1]], &c = projected_[v[2]];
                const int x0 = first_centre(std::min({a.x, b.x, c.x}));
                const int x1 = std::max({a.x, b.x, c.x}) >> sub_pixel_bits;
                const int y0 = first_centre(std::min({a.y, b.y, c.y}));
                const int y1 = std::max({a.y, b.y, c.y}) >> sub_pixel_bits;
                if (x0 > x1 || y0 > y1) continue;  // between pixel centres
                for (int y = y0 / tile_size; y <= y1 / tile_size; ++y)
                    for (int x = x0 / tile_size; x <= x1 / tile_size; ++x)
                        bins[static_cast<std::size_t>(y) * tiles_x_ + x].push_back(static_cast<std::uint32_t>(t));
            }
        }
    });
}

/// Through the vertices in the order of their numbers: triangles on the same three vertices then have the same
/// depths to the last bit.
TransilluminationBuffer::Plane TransilluminationBuffer::depth_plane(std::uint32_t root) const {
    std::array<std::uint32_t, 3> v = mesh_.triangles[root].vertices;
    if (v[0] > v[1]) std::swap(v[0], v[1]);
    if (v[1] > v[2]) std::swap(v[1], v[2]);
    if (v[0] > v[1]) std::swap(v[0], v[1]);
    const ProjectedVertex &a = projected_[v[0]], &b = projected_[v[1]], &c = projected_[v[2]];
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double scale = fixed_unit / (bx * cy - cx * by);
    const double zb = b.depth - a.depth, zc = c.depth - a.depth;
    return {a.x / fixed_unit, a.y / fixed_unit, a.depth, (zb * cy - zc * by) * scale, (zc * bx - zb * cx) * scale};
}

/// Barycentric coordinates of the second and third vertex, about the first.
std::array<TransilluminationBuffer::Plane, 2> TransilluminationBuffer::barycentric_planes(const std::array<FixedPoint, 3>& v,
                                                                                          std::int64_t twice_area) {
    const double scale = fixed_unit / static_cast<double>(twice_area);
    const double x = v[0].x / fixed_unit, y = v[0].y / fixed_unit;
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

/// The order of two fragments whose 31 bits of depth all but agree. Vertices were moved within the window, not in
/// depth, so the depths of coinciding surfaces differ a little: there their keys decide, elsewhere their planes do.
bool TransilluminationBuffer::is_behind(Fragment a, Fragment b, int x, int y) const {
    const std::uint32_t root_a = patches_.root_of_leaf[leaf_of(a)], root_b = patches_.root_of_leaf[leaf_of(b)];
    const double distance = depth_plane(root_a).at(x, y) - depth_plane(root_b).at(x, y);
    if (std::abs(distance) <= depth_rounding || are_coplanar(root_a, root_b))
        return static_cast<std::uint32_t>(a) > static_cast<std::uint32_t>(b);
    return distance > 0.0;
}

/// Lists are short: insertion sort.
void TransilluminationBuffer::sort_list(Fragment* begin, Fragment* end, int x, int y) const {
    constexpr Fragment near = std::uint64_t{1} << (32 + 13);
    bool any_near = false;
    for (Fragment* i = begin + 1; i < end; ++i) {
        const Fragment f = *i;
        Fragment* j = i;
        for (; j > begin && j[-1] > f; --j) *j = j[-1];
        *j = f;
    }
    for (const Fragment* i = begin + 1; i < end; ++i) any_near |= i[0] - i[-1] < near;
    if (!any_near) return;
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

    // The window's axes and the direction are right-handed: a positive area is seen from ahead.
    const std::uint64_t facing = area > 0 ? 0x80000000u : 0u;
    const RootPatches& patches = patches_.roots[root];
    std::array<Plane, 2> b{};
    if (patches.level > 0) b = barycentric_planes(fixed, area);
    if (area < 0) std::swap(fixed[1], fixed[2]);
    // A slope that does not fit belongs to a span of one pixel, where it is not used.
    const auto dz = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::clamp(depth.dx, -0x1p62, 0x1p62)));

    const std::uint64_t low = facing | patches.first_leaf;
    const auto ds = static_cast<float>(b[0].dx), dt = static_cast<float>(b[1].dx);

    scratch.reserve();
    Fragment* out = scratch.drawn.data() + scratch.count;
    std::uint16_t* pixel = scratch.pixel.data() + scratch.count;
    std::uint32_t* const lengths = scratch.first.data() + 1;
    const int width = rect.x1 - rect.x0;
    std::array<std::uint64_t, block> ramp;
    for (int i = 0; i < block; ++i) ramp[i] = static_cast<std::uint64_t>(i) * dz;
    scan_convert(fixed, rect, [&](std::int32_t y, std::int32_t x0, std::int32_t x1) __attribute__((always_inline)) {
        int at = (y - rect.y0) * width + (x0 - rect.x0);
        int length = x1 - x0;
        auto z = static_cast<std::uint64_t>(std::clamp(depth.at(x0, y), 0.0, 0x1p63));
        auto s0 = static_cast<float>(b[0].at(x0, y)), t0 = static_cast<float>(b[1].at(x0, y));
        // Whole blocks, of which the next span overwrites what is too much: short spans would mispredict a loop's end.
        for (; length > 0; length -= block) {
            const std::array<std::uint32_t, block> leaf = patches.level == 0 ? std::array<std::uint32_t, block>{}
                                                                             : leaves_of_block(patches.level, s0, ds, t0, dt);
            for (int i = 0; i < block; ++i) out[i] = ((z + ramp[i]) & depth_bits) | (low + leaf[i]);
            for (int i = 0; i < block; ++i) pixel[i] = static_cast<std::uint16_t>(at + i);
            for (int i = 0; i < block; ++i) lengths[at + i] += i < length ? 1 : 0;
            const int taken = std::min(length, block);
            out += taken;
            pixel += taken;
            at += block;
            z += block * dz;
            s0 += block * ds;
            t0 += block * dt;
        }
    });
    scratch.count = static_cast<std::size_t>(out - scratch.drawn.data());
}

void TransilluminationBuffer::fill_tile(int tile, Scratch& scratch) const {
    const int x0 = tile % tiles_x_ * tile_size, y0 = tile / tiles_x_ * tile_size;
    scratch.rect = {x0, y0, std::min(x0 + tile_size, width_), std::min(y0 + tile_size, height_)};
    const int pixels = (scratch.rect.x1 - x0) * (scratch.rect.y1 - y0);
    std::fill_n(scratch.first.begin(), pixels + 1, 0u);
    scratch.count = 0;
    for (const Bins& bins : bins_)
        for (const std::uint32_t root : bins[tile]) draw(root, scratch.rect, scratch);
    if (scratch.count == 0) return;

    // Counting sort by pixel. While filling, first[i] runs from the start of list i to its end, which is
    // the start of list i + 1: shifting by one restores it.
    auto& first = scratch.first;
    std::partial_sum(first.begin(), first.begin() + pixels + 1, first.begin());
    if (scratch.sorted.size() < scratch.count) scratch.sorted.resize(scratch.drawn.size());
    Fragment* const sorted = scratch.sorted.data();
    const Fragment* const drawn = scratch.drawn.data();
    const std::uint16_t* const pixel = scratch.pixel.data();
    std::uint32_t* const place = first.data();
    for (std::size_t i = 0, count = scratch.count; i < count; ++i) sorted[place[pixel[i]]++] = drawn[i];
    std::copy_backward(first.begin(), first.begin() + pixels, first.begin() + pixels + 1);
    first[0] = 0;
    const int width = scratch.rect.x1 - x0;
    for (int i = 0; i < pixels; ++i)
        if (first[i + 1] - first[i] > 1)
            sort_list(sorted + first[i], sorted + first[i + 1], x0 + i % width, y0 + i / width);
}

void TransilluminationBuffer::trace(const Bundle& bundle, const Workers& workers, const Visitor& visit) {
    project(bundle, workers);
    bin(workers);
    scratch_.resize(std::max<std::size_t>(scratch_.size(), workers.count()));
    workers.for_ranges(static_cast<std::size_t>(tiles_x_) * tiles_y_, 1, [&](std::size_t begin, std::size_t end, int worker) {
        for (std::size_t tile = begin; tile < end; ++tile) {
            Scratch& s = scratch_[worker];
            fill_tile(static_cast<int>(tile), s);
            if (s.count == 0) continue;
            visit({s.rect.x1 - s.rect.x0, s.rect.y1 - s.rect.y0, s.rect.y0, s.first, {s.sorted.data(), s.count}}, worker);
        }
    });
}

}  // namespace transillum
