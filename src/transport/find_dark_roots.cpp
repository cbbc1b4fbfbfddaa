#include <transillum/transport/find_dark_roots.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <algorithm>
#include <chrono>

namespace transillum {

namespace {

/// Less is not worth the search.
constexpr double least_surface = 0.05;
/// Directions without news after which what was not reached is dark, and most in all. However many
/// the iteration takes: one that goes on must come to the same.
constexpr std::uint64_t calm_directions = 64, most_directions = 128;
/// After so many, most of what could be left out has been met.
constexpr std::uint64_t first_directions = 8;
/// Share of an iteration's time that the search may take.
constexpr double share_of_time = 0.125;

/// A root's side is number 2 * root + back; what is outside comes after the last.
class Search {
public:
    Search(const SurfaceMesh& mesh, const PatchHierarchy& patches, const PatchSources& sources,
           const Workers& workers)
        : mesh_(mesh),
          patches_(patches),
          outside_(2 * mesh.triangles.size()),
          shines_(outside_ + 1),
          passes_on_(outside_ + 1),
          state_(outside_ + 1),
          seen_(static_cast<std::size_t>(workers.count()), state_) {
        for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
            const std::uint32_t root = patches.root_of_leaf[patches.leaf_of_patch(p)];
            const std::size_t side = 2 * std::size_t{root} + (patches.is_back(p) ? 1 : 0);
            if (max_channel(sources.emission[p]) > 0.0f || max_channel(sources.direct[p]) > 0.0f)
                shines_[side] = 1;
            const bool is_glossy =
                !sources.glossy.empty() && sources.glossy.of_root_side[side] != GlossySides::none;
            if (is_glossy || max_channel(sources.albedo[p]) > 0.0f) passes_on_[side] = 1;
        }
        is_source_ = shines_;
        shines_[outside_] = sources.environment.shines() ? 1 : 0;
        for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r) area_ += area_of(mesh, r);
    }

    /// \returns whether light was found where none seemed to come
    bool follow(TransilluminationBuffer& buffer, const Bundle& bundle, const Workers& workers) {
        buffer.trace(bundle, workers, [&](const TileLists& tile, int worker) {
            follow(tile, seen_[static_cast<std::size_t>(worker)]);
        });
        bool news = false;
        for (std::size_t side = 0; side < outside_; ++side) {
            std::uint8_t now = state_[side];
            for (const auto& seen : seen_) now |= seen[side];
            if (now == state_[side]) continue;
            // Known to be there, and reached only now.
            news = news || (is_met(side / 2) && !is_reached(side / 2) && (now & reached) != 0);
            state_[side] = now;
            if ((now & reached) != 0 && passes_on_[side]) shines_[side] = 1;
        }
        return news;
    }

    [[nodiscard]] bool all_sources_are_met() const {
        for (std::size_t side = 0; side < outside_; ++side)
            if (is_source_[side] && (state_[side] & met) == 0) return false;
        return true;
    }
    /// Share of the surface that is not reached. \param met_alone of what has been met at all
    [[nodiscard]] double unreached_surface(bool met_alone) const {
        double unreached = 0.0;
        for (std::uint32_t r = 0; r < mesh_.triangles.size(); ++r)
            if (!is_reached(r) && (is_met(r) || !met_alone)) unreached += area_of(mesh_, r);
        return unreached / area_;
    }
    [[nodiscard]] DarkRoots result(std::uint64_t directions) const {
        DarkRoots dark{std::vector<std::uint8_t>(mesh_.triangles.size()), 0, 0.0, directions};
        for (std::uint32_t r = 0; r < mesh_.triangles.size(); ++r) {
            if (is_reached(r) || !is_met(r)) continue;
            dark.is_dark[r] = 1;
            ++dark.count;
            dark.surface += area_of(mesh_, r) / area_;
        }
        if (!(dark.surface >= least_surface)) return {};
        return dark;
    }

private:
    static constexpr std::uint8_t met = 1, reached = 2;

    void follow(const TileLists& tile, std::vector<std::uint8_t>& seen) const {
        const auto face = [&](std::size_t a, std::size_t b) {
            seen[a] |= static_cast<std::uint8_t>(met | (shines_[b] ? reached : 0));
            seen[b] |= static_cast<std::uint8_t>(met | (shines_[a] ? reached : 0));
        };
        const auto pixels = static_cast<std::size_t>(tile.width) * tile.height;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            std::size_t behind = outside_;
            for (std::uint32_t i = tile.first[pixel]; i < tile.first[pixel + 1]; ++i) {
                const Fragment f = tile.fragments[i];
                const std::size_t front = 2 * std::size_t{patches_.root_of_leaf[leaf_of(f)]};
                const bool forwards = front_faces_forwards(f);
                face(behind, front + (forwards ? 1 : 0));
                behind = front + (forwards ? 0 : 1);
            }
            if (behind != outside_) face(behind, outside_);
        }
    }
    [[nodiscard]] bool is_met(std::size_t root) const {
        return ((state_[2 * root] | state_[2 * root + 1]) & met) != 0;
    }
    [[nodiscard]] bool is_reached(std::size_t root) const {
        return ((state_[2 * root] | state_[2 * root + 1]) & reached) != 0 ||
               is_source_[2 * root] != 0 || is_source_[2 * root + 1] != 0;
    }

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    std::size_t outside_;
    std::vector<std::uint8_t> shines_, passes_on_, is_source_;
    std::vector<std::uint8_t> state_;              ///< met, reached
    std::vector<std::vector<std::uint8_t>> seen_;  ///< the same, of each worker
    double area_ = 0.0;
};

}  // namespace

DarkRoots find_dark_roots(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                          const PatchSources& sources, const IterationOptions& options,
                          const Workers& workers, Monitor& monitor) {
    if (sources.directional_emission) return {};
    const auto start = std::chrono::steady_clock::now();
    const auto is_late = [&] {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        return options.seconds > 0.0 && elapsed.count() > share_of_time * options.seconds;
    };
    Search search(mesh, patches, sources, workers);
    TransilluminationBuffer buffer(mesh, patches, options.pixel_size);
    std::uint64_t calm = 0;
    for (std::uint64_t i = 0; i < most_directions && !monitor.stop_requested() && !is_late(); ++i) {
        const bool news = search.follow(
            buffer, sample_bundle(static_cast<std::uint32_t>(i), options.seed), workers);
        calm = news ? 0 : calm + 1;
        if (search.unreached_surface(i + 1 >= first_directions) < least_surface) return {};
        if (calm >= calm_directions && search.all_sources_are_met()) return search.result(i + 1);
    }
    return {};
}

}  // namespace transillum
