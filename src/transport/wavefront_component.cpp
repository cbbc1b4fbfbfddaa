#include "transport/coplanar_groups.h"
#include "transport/monte_carlo_component.h"
#include "transport/residual_exchange.h"

#include <transillum/base/sampling.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace transillum {

namespace {

using Lanes = BundleReflection::Lanes;

constexpr std::size_t grain = 4096;
constexpr int tile_bits = 6, tile_edge = 1 << tile_bits;
constexpr int tiles_a_row = 256;  ///< of the widest window
/// Where surfaces curve, a sample of a neighbouring root may lie this many pixels off in depth, per
/// unit of slope; steeper slopes than the largest are not told apart.
constexpr double depth_pixels = 2.0, largest_slope = 16.0;
/// Luminance in the norms is counted in steps of the largest radiance over 2^34. Their squares add
/// up in 128 bits.
constexpr int norm_bits = 34;

/// A surface point behind a pixel.
struct WavePoint {
    std::uint32_t depth;    ///< as a fragment's upper bits
    std::uint32_t surface;  ///< 2 * its coplanar group + whether the front faces forwards
    std::array<glm::vec3, 2> arrived;  ///< on the lower and on the upper side
};

struct WaveTile {
    int width = 0, height = 0;  ///< 0: nothing there
    std::vector<std::uint32_t> first;
    std::vector<WavePoint> points;
};

struct Wavefront {
    std::vector<WaveTile> tiles = std::vector<WaveTile>(tiles_a_row * tiles_a_row);
    WindowTransform window;
    glm::vec3 direction{0.0f, 0.0f, 1.0f};

    static std::size_t tile_at(int column, int row) {
        return static_cast<std::size_t>(row >> tile_bits) * tiles_a_row + (column >> tile_bits);
    }
    [[nodiscard]] std::span<const WavePoint> list(std::int64_t column, std::int64_t row) const {
        constexpr std::int64_t widest = std::int64_t{tiles_a_row} << tile_bits;
        if (column < 0 || row < 0 || column >= widest || row >= widest) return {};
        const WaveTile& t = tiles[tile_at(static_cast<int>(column), static_cast<int>(row))];
        const int x = static_cast<int>(column) % tile_edge, y = static_cast<int>(row) % tile_edge;
        if (x >= t.width || y >= t.height) return {};
        const int pixel = y * t.width + x;
        return std::span(t.points).subspan(t.first[pixel], t.first[pixel + 1] - t.first[pixel]);
    }
};

/// Of a slot, in integers: what arrived, and the luminance sent in two powers.
struct SlotTally {
    FixedRadiance arrived;
    std::int64_t sent = 0, count = 0;
    __extension__ __int128 sent_squared = 0;
};

class WavefrontComponent final : public MonteCarloComponent {
public:
    WavefrontComponent(const SurfaceMesh& mesh, const PatchHierarchy& patches, Carried carried,
                       const Workers& workers)
        : MonteCarloComponent(patches.leaf_count, carried),
          patches_(patches),
          workers_(workers),
          group_(coplanar_groups(mesh)),
          tallies_(workers.count(), std::vector<SlotTally>(arrived_.size())) {
        for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r)
            normal_.emplace_back(normal_of(mesh, r));
    }

    [[nodiscard]] const PatchHierarchy& cells() const override { return patches_; }

    void reflect(std::span<const BundleReflection> reflections, const Exchange& exchange) override {
        reflections_ = reflections;
        exchange_ = &exchange;
        ++directions_;
    }

    void begin(const Bundle& bundle) override {
        if (carried_ != Carried::nothing) std::swap(last_, current_);
        for (WaveTile& t : current_.tiles) t.width = t.height = 0;
        current_.direction = bundle.frame[2];
    }

    void exchange_tile(const TileLists& tile, const TransilluminationBuffer& buffer,
                       const ExchangeTables& tables, int cluster_row, ExchangeTally& tally,
                       int worker) override;

    void end(const TransilluminationBuffer& buffer, const ExchangeTables& tables) override {
        current_.window = buffer.window();
        const double step = norm_step(tables.unit);
        workers_.for_ranges(arrived_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t slot = begin; slot < end; ++slot) fold(slot, tables, step);
        });
    }

    [[nodiscard]] Spectrum incoming(const SurfaceSide& p) const override {
        const std::uint32_t leaf = patches_.leaf_at(p.root, p.b1, p.b2);
        const glm::dvec3 at = current_.window.to_window(p.position);
        // The same point has the same neighbours in every thread.
        const std::uint64_t random = hash_bits(std::bit_cast<std::uint64_t>(at.x) ^
                                               hash_bits(std::bit_cast<std::uint64_t>(at.y)));
        const WavePoint* const w = find(current_, p.root, at, random);
        if (!w)
            return arrived(slot_of_patch(p.back ? leaf + patches_.leaf_count : leaf,
                                         patches_.leaf_count))
                .radiance;
        // Light along the direction meets the lower side, which is the back of what faces forwards.
        const bool is_lower = ((w->surface & 1u) != 0) == p.back;
        return w->arrived[is_lower ? 0 : 1];
    }

    [[nodiscard]] Spectrum incoming_of_cell(std::uint32_t cell_patch) const override {
        return arrived(slot_of_patch(cell_patch, patches_.leaf_count)).radiance;
    }

private:
    struct Layer;

    /// The point of a wavefront that stands for one of a root: of one of the four nearest pixels,
    /// drawn by their bilinear weights. Null where none does. \param at in its window
    [[nodiscard]] const WavePoint* find(const Wavefront& wavefront, std::uint32_t root,
                                        const glm::dvec3& at, std::uint64_t random) const {
        const double u = static_cast<double>(random >> 32) * 0x1p-32;
        const double v = static_cast<double>(random & 0xffffffffu) * 0x1p-32;
        const auto list = wavefront.list(static_cast<std::int64_t>(std::floor(at.x + u)),
                                         static_cast<std::int64_t>(std::floor(at.y + v)));
        const float cosine = glm::dot(normal_[root], wavefront.direction);
        const std::uint32_t forwards = cosine > 0.0f ? 1 : 0;
        const std::uint32_t surface = 2 * group_[root] + forwards;
        const double c2 = double{cosine} * cosine;
        const double slope =
            std::min(largest_slope, std::sqrt(std::max(0.0, 1.0 - c2) / std::max(c2, 1e-12)));
        const double depth_a_pixel = wavefront.window.scale.z / wavefront.window.scale.x;
        double nearest = depth_pixels * depth_a_pixel * (1.0 + slope);
        const WavePoint* found = nullptr;
        for (const WavePoint& w : list) {
            if (w.surface == surface) return &w;
            const double distance = std::abs(w.depth - at.z);
            if ((w.surface & 1u) != forwards || distance >= nearest) continue;
            nearest = distance;
            found = &w;
        }
        return found;
    }

    /// Nothing is sent, and counted, where nothing is carried.
    [[nodiscard]] double norm_step(double unit) const {
        if (carried_ == Carried::nothing) return 1.0;
        return unit * std::ldexp(1.0, exchange_->bits() - norm_bits);
    }

    void fold(std::size_t slot, const ExchangeTables& tables, double step) {
        SlotTally all;
        for (auto& tally : tallies_) {
            const SlotTally t = std::exchange(tally[slot], {});
            all.arrived += t.arrived;
            all.sent += t.sent;
            all.sent_squared += t.sent_squared;
            all.count += t.count;
        }
        const auto coverage = static_cast<float>(all.arrived.lane[3]);
        arrived_[slot] = {
            coverage > 0.0f ? tables.in_units(all.arrived) / coverage : Spectrum(0.0f), coverage};
        if (all.count == 0) return;
        const auto n = static_cast<double>(all.count);
        const double shift = step * static_cast<double>(all.sent) / n;
        const double square = step * step * static_cast<double>(all.sent_squared) / n;
        norms_[slot].spatial += std::max(0.0, square - shift * shift);
        norms_[slot].directional += shift * shift;
    }

    const PatchHierarchy& patches_;
    const Workers& workers_;
    std::vector<std::uint32_t> group_;  ///< one a root
    std::vector<glm::vec3> normal_;     ///< one a root
    std::span<const BundleReflection> reflections_;
    const Exchange* exchange_ = nullptr;
    Wavefront last_, current_;
    std::vector<std::vector<SlotTally>> tallies_;  ///< one a worker
};

struct WavefrontComponent::Layer {
    Layer(const WavefrontComponent& component, const WindowTransform& window,
          const ExchangeTables& tables, WaveTile& made, std::vector<SlotTally>& tallies)
        : c(component),
          tables(tables),
          made(made),
          tallies(tallies),
          steps(1.0 / c.norm_step(tables.unit)) {
        const auto in_last = [&](const glm::dvec3& p) {
            return c.last_.window.to_window(window.to_scene(p));
        };
        origin = in_last(glm::dvec3(0.0));
        for (int i = 0; i < 3; ++i) {
            glm::dvec3 axis(0.0);
            axis[i] = 1.0;
            to_last[i] = in_last(axis) - origin;
        }
        key = hash_bits(c.directions_);
    }

    ResidualPoint point(Fragment f, std::uint32_t i, int column, int row) {
        const std::uint32_t root = c.patches_.root_of_leaf[leaf_of(f)];
        const bool forwards = front_faces_forwards(f);
        WavePoint& w = made.points[i];
        w.depth = static_cast<std::uint32_t>(f >> 32);
        w.surface = 2 * c.group_[root] + (forwards ? 1 : 0);

        ResidualPoint p;
        p.upper = upper_slot(f);
        p.lower = p.upper ^ 1u;
        if (c.carried_ == Carried::nothing) return p;
        const WavePoint* const last = c.directions_ > 1 ? find(f, root, column, row) : nullptr;
        // Fronts and backs may have changed places.
        const int upper = last && ((last->surface & 1u) != 0) != forwards ? 0 : 1;
        p.from_lower = sent(p.lower, last ? &last->arrived[1 - upper] : nullptr);
        p.from_upper = sent(p.upper, last ? &last->arrived[upper] : nullptr);
        return p;
    }

    void arrive_at_lower(const ResidualPoint& p, std::uint32_t i, const FixedRadiance& r) {
        tallies[p.lower].arrived += r;
        made.points[i].arrived[0] = tables.in_units(r);
    }
    void arrive_at_upper(const ResidualPoint& p, std::uint32_t i, const FixedRadiance& r) {
        tallies[p.upper].arrived += r;
        made.points[i].arrived[1] = tables.in_units(r);
    }

private:
    [[nodiscard]] const WavePoint* find(Fragment f, std::uint32_t root, int column, int row) const {
        const glm::dvec3 at =
            origin + to_last * glm::dvec3(column, row, static_cast<double>(f >> 32));
        const std::uint64_t random =
            hash_bits(key ^ (static_cast<std::uint64_t>(column) << 32 ^
                             static_cast<std::uint64_t>(row) << 8 ^ f >> 32 << 16));
        return c.find(c.last_, root, at, random);
    }

    /// \param arrived null where nothing is known but the patch's mean
    FixedRadiance sent(std::uint32_t slot, const glm::vec3* arrived) {
        const BundleReflection& r = c.reflections_[slot];
        const glm::vec3& in = arrived ? *arrived : c.arrived_[slot].radiance;
        const Lanes out = r.gain * Lanes{in.x, in.y, in.z, 0.0f} - r.projection;
        const Spectrum radiance(out[0], out[1], out[2]);
        SlotTally& t = tallies[slot];
        const auto q = std::llrint(luminance(SpectrumSum(radiance)) * steps);
        const std::int64_t limited = std::clamp<std::int64_t>(q, -(std::int64_t{1} << norm_bits),
                                                              std::int64_t{1} << norm_bits);
        t.sent += limited;
        t.sent_squared += static_cast<__int128>(limited) * limited;
        ++t.count;
        return c.exchange_->fixed(radiance);
    }

    const WavefrontComponent& c;
    const ExchangeTables& tables;
    WaveTile& made;
    std::vector<SlotTally>& tallies;
    double steps;
    glm::dvec3 origin{0.0};
    glm::dmat3 to_last{1.0};
    std::uint64_t key = 0;
};

void WavefrontComponent::exchange_tile(const TileLists& tile, const TransilluminationBuffer& buffer,
                                       const ExchangeTables& tables, int cluster_row,
                                       ExchangeTally& tally, int worker) {
    WaveTile& made = current_.tiles[Wavefront::tile_at(tile.column0, tile.row0)];
    made.width = tile.width;
    made.height = tile.height;
    made.first.assign(tile.first.begin(), tile.first.begin() + tile.width * tile.height + 1);
    made.points.resize(tile.fragments.size());
    Layer layer(*this, buffer.window(), tables, made, tallies_[worker]);
    exchange_with_residual(tile, tables, cluster_row, carried_, tally, layer);
}

}  // namespace

std::unique_ptr<MonteCarloComponent> make_wavefront_component(const SurfaceMesh& mesh,
                                                              const PatchHierarchy& patches,
                                                              Carried carried,
                                                              const Workers& workers) {
    return std::make_unique<WavefrontComponent>(mesh, patches, carried, workers);
}

}  // namespace transillum
