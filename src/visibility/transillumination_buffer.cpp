#include <transillum/base/error.h>
#include <transillum/base/sampling.h>
#include <transillum/visibility/transillumination_buffer.h>

#include "visibility/transillumination_tile.h"

#include <glm/geometric.hpp>

#include <bit>
#include <cmath>
#include <numbers>
#include <string>

namespace transillum {

namespace {

constexpr std::uint32_t triangles_a_bin_set = 1u << 14;
/// Depths are 63-bit integers; the margin takes up rounding.
constexpr double depth_margin = 0x1p40;

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

Bundle sample_bundle(std::uint32_t index, std::uint64_t seed) {
    const auto u = [&](int dimension) { return sobol_owen(index, dimension, seed); };
    const glm::dmat3 frame = frame_about(uniform_direction(u(0), u(1)));
    const double turn = 2.0 * std::numbers::pi * u(2);
    const double c = std::cos(turn), s = std::sin(turn);
    return {{c * frame[0] + s * frame[1], c * frame[1] - s * frame[0], frame[2]},
            u(3),
            u(4),
            static_cast<int>(256.0 * u(5))};
}

double pixel_size_for(const SurfaceMesh& mesh, int resolution) {
    if (resolution < 16 || resolution > 8192)
        throw UsageError("resolution " + std::to_string(resolution) +
                         "; accepted: 16 to 8192 pixels");
    const Bounds b = bounds_of(mesh.positions, glm::dmat3(1.0));
    const glm::dvec3 size = b.high - b.low;
    // The mean width of a box over all directions is half the sum of its edges.
    return (size.x + size.y + size.z) / 2.0 / resolution;
}

double automatic_pixel_size(const SurfaceMesh& mesh, const PatchHierarchy& patches) {
    constexpr double pixels_a_leaf_edge = 3.0;
    constexpr int least_resolution = 256, largest_resolution = 4096;
    double area = 0.0;
    for (std::uint32_t root = 0; root < mesh.triangles.size(); ++root) area += area_of(mesh, root);
    const double wanted = std::sqrt(2.0 * area / patches.leaf_count) / pixels_a_leaf_edge;
    return std::clamp(wanted, pixel_size_for(mesh, largest_resolution),
                      pixel_size_for(mesh, least_resolution));
}

TransilluminationBuffer::TransilluminationBuffer(const SurfaceMesh& mesh,
                                                 const PatchHierarchy& patches, double pixel_size)
    : mesh_(mesh), patches_(patches), pixel_size_(pixel_size), projected_(mesh.positions.size()) {
    const Bounds b = bounds_of(mesh.positions, glm::dmat3(1.0));
    const double widest = glm::length(b.high - b.low) / pixel_size;
    if (!(pixel_size > 0.0 && widest < max_window - 2))
        throw UsageError("pixel size " + std::to_string(pixel_size) + ": the window would be " +
                         std::to_string(widest) + " pixels wide; accepted: at most " +
                         std::to_string(max_window));
    // The finer vertices are snapped, the closer surfaces may pass each other.
    sub_pixel_bits_ =
        window_bits - static_cast<int>(std::bit_width(static_cast<unsigned>(widest) + 2));
    fixed_unit_ = std::ldexp(1.0, sub_pixel_bits_);
    const glm::dvec3 furthest = glm::max(glm::abs(b.low), glm::abs(b.high));
    plane_tolerance_ = std::max({furthest.x, furthest.y, furthest.z}) * 0x1p-38;
    bins_.resize((mesh.triangles.size() + triangles_a_bin_set - 1) / triangles_a_bin_set);
}

TransilluminationBuffer::~TransilluminationBuffer() = default;

void TransilluminationBuffer::project(const Bundle& bundle, const Workers& workers) {
    constexpr std::size_t grain = 4096;
    std::vector<Bounds> partial((mesh_.positions.size() + grain - 1) / grain);
    workers.for_ranges(partial.size(), 1, [&](std::size_t begin, std::size_t end, int worker) {
        StageClock clock;
        for (std::size_t r = begin; r < end; ++r) {
            Bounds b;
            for (std::size_t i = r * grain; i < std::min((r + 1) * grain, mesh_.positions.size());
                 ++i) {
                const glm::dvec3 q = mesh_.positions[i] * bundle.frame;
                b.low = glm::min(b.low, q);
                b.high = glm::max(b.high, q);
            }
            partial[r] = b;
        }
        clock.lap(scratch_[worker].seconds.project);
    });
    Bounds b;
    for (const Bounds& p : partial) {
        b.low = glm::min(b.low, p.low);
        b.high = glm::max(b.high, p.high);
    }
    const double scale = fixed_unit_ / pixel_size_;
    const glm::dvec2 shift =
        glm::dvec2(bundle.offset_x, bundle.offset_y) * fixed_unit_ - glm::dvec2(b.low) * scale;
    const double range = b.high.z - b.low.z;
    const double depth_scale = range > 0.0 ? (0x1p63 - 2.0 * depth_margin) / range : 0.0;
    constexpr double depth_step = 0x1p32;  // fragments keep the upper bits
    window_ = {
        bundle.frame, glm::dvec3(1.0 / pixel_size_, 1.0 / pixel_size_, depth_scale / depth_step),
        glm::dvec3(shift / fixed_unit_, (depth_margin - b.low.z * depth_scale) / depth_step)};
    width_ = static_cast<int>(std::ceil((b.high.x - b.low.x) / pixel_size_)) + 2;
    height_ = static_cast<int>(std::ceil((b.high.y - b.low.y) / pixel_size_)) + 2;
    tiles_x_ = (width_ + tile_size - 1) / tile_size;
    tiles_y_ = (height_ + tile_size - 1) / tile_size;
    workers.for_ranges(
        mesh_.positions.size(), grain, [&](std::size_t begin, std::size_t end, int worker) {
            StageClock clock;
            for (std::size_t i = begin; i < end; ++i) {
                const glm::dvec3 q = mesh_.positions[i] * bundle.frame;
                projected_[i] = {static_cast<std::int32_t>(std::lrint(q.x * scale + shift.x)),
                                 static_cast<std::int32_t>(std::lrint(q.y * scale + shift.y)),
                                 depth_margin + (q.z - b.low.z) * depth_scale};
            }
            clock.lap(scratch_[worker].seconds.project);
        });
}

void TransilluminationBuffer::bin(const Workers& workers) {
    const std::size_t tiles = static_cast<std::size_t>(tiles_x_) * tiles_y_;
    workers.for_ranges(bins_.size(), 1, [&](std::size_t begin, std::size_t end, int worker) {
        StageClock clock;
        for (std::size_t set = begin; set < end; ++set) {
            Bins& bins = bins_[set];
            if (bins.size() < tiles) bins.resize(tiles);
            for (auto& bin : bins) bin.clear();
            const std::size_t last =
                std::min<std::size_t>((set + 1) * triangles_a_bin_set, mesh_.triangles.size());
            for (std::size_t t = set * triangles_a_bin_set; t < last; ++t) {
                const auto& v = mesh_.triangles[t].vertices;
                const ProjectedVertex &a = projected_[v[0]], &b = projected_[v[1]],
                                      &c = projected_[v[2]];
                const int x0 = first_centre(std::min({a.x, b.x, c.x}), sub_pixel_bits_);
                const int x1 = std::max({a.x, b.x, c.x}) >> sub_pixel_bits_;
                const int y0 = first_centre(std::min({a.y, b.y, c.y}), sub_pixel_bits_);
                const int y1 = std::max({a.y, b.y, c.y}) >> sub_pixel_bits_;
                if (x0 > x1 || y0 > y1) continue;  // between pixel centres
                for (int y = y0 / tile_size; y <= y1 / tile_size; ++y)
                    for (int x = x0 / tile_size; x <= x1 / tile_size; ++x)
                        bins[static_cast<std::size_t>(y) * tiles_x_ + x].push_back(
                            static_cast<std::uint32_t>(t));
            }
        }
        clock.lap(scratch_[worker].seconds.bin);
    });
}

void TransilluminationBuffer::trace(const Bundle& bundle, const Workers& workers,
                                    const Visitor& visit) {
    scratch_.resize(std::max<std::size_t>(scratch_.size(), workers.count()));
    project(bundle, workers);
    bin(workers);
    workers.for_ranges(static_cast<std::size_t>(tiles_x_) * tiles_y_, 1,
                       [&](std::size_t begin, std::size_t end, int worker) {
                           Scratch& s = scratch_[worker];
                           for (std::size_t tile = begin; tile < end; ++tile) {
                               fill_tile(static_cast<int>(tile), s);
                               if (s.count == 0) continue;
                               StageClock clock;
                               visit({s.rect.x1 - s.rect.x0,
                                      s.rect.y1 - s.rect.y0,
                                      s.rect.y0,
                                      s.rect.x0,
                                      s.first,
                                      {s.sorted.data(), s.count}},
                                     worker);
                               clock.lap(s.seconds.visit);
                           }
                       });
}

StageSeconds TransilluminationBuffer::seconds() const {
    StageSeconds sum;
    for (const Scratch& s : scratch_) sum += s.seconds;
    return sum;
}

}  // namespace transillum
