#include "render/shadow_edges.h"

#include <algorithm>
#include <bit>

namespace transillum {

namespace {

using Word = ShadowEdges::Word;
constexpr std::size_t samples_a_word = ShadowEdges::samples_a_word;

std::size_t words_for(std::size_t samples) {
    return (samples + samples_a_word - 1) / samples_a_word;
}

/// What a row of visibilities says. Samples behind the horizon are neither seen nor hidden, which
/// leaves it to the neighbours.
struct Found {
    std::uint64_t seen = 0, hidden = 0, facing = 0;
};

std::vector<Found> what_patches_found(const DirectLight& light, std::size_t patches,
                                      std::size_t words, const Workers& workers) {
    const std::size_t n = light.samples.size();
    std::vector<Found> found(patches * words);
    workers.for_ranges(patches, 256, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t p = begin; p < end; ++p)
            for (std::size_t i = 0; i < n; ++i) {
                if (!(light.geometry_factor[p * n + i] > 0.0f)) continue;
                Found& word = found[p * words + i / samples_a_word];
                const std::uint64_t bit = std::uint64_t{1} << (i % samples_a_word);
                word.facing |= bit;
                if (light.visibility[p * n + i] >= 1.0f) word.seen |= bit;
                if (!(light.visibility[p * n + i] > 0.0f)) word.hidden |= bit;
            }
    });
    return found;
}

}  // namespace

ShadowEdges::ShadowEdges(const DirectLight& light)
    : words_(words_for(light.samples.size())), of_patches_(words_) {
    for (std::size_t i = 0; i < light.samples.size(); ++i)
        of_patches_[i / samples_a_word].doubtful |= std::uint64_t{1} << (i % samples_a_word);
}

ShadowEdges::ShadowEdges(const DirectLight& light, const PatchHierarchy& patches,
                         const VertexGrid& grid, const Workers& workers)
    : ShadowEdges(light) {
    const std::vector<Word> all = std::move(of_patches_);
    const std::vector<Found> found =
        what_patches_found(light, patches.patch_count(), words_, workers);
    row_size_ = words_;
    of_patches_.resize(found.size());
    workers.for_ranges(patches.patch_count(), 256, [&](std::size_t begin, std::size_t end, int) {
        std::vector<Found> around(words_);
        for (std::size_t p = begin; p < end; ++p) {
            const std::uint32_t leaf = patches.leaf_of_patch(static_cast<std::uint32_t>(p));
            const std::size_t side = p - leaf;
            const auto own = found.begin() + static_cast<std::ptrdiff_t>(p * words_);
            std::copy_n(own, words_, around.begin());
            for (Found& word : around) word.hidden |= ~word.facing;
            for (const std::uint32_t vertex : grid.leaf_vertices[leaf])
                for (const std::uint32_t neighbour : grid.leaves_at(vertex))
                    for (std::size_t w = 0; w < words_; ++w) {
                        const Found& there = found[(neighbour + side) * words_ + w];
                        around[w].seen &= there.seen | ~there.facing;
                        around[w].hidden &= there.hidden | ~there.facing;
                    }
            for (std::size_t w = 0; w < words_; ++w)
                of_patches_[p * words_ + w] = {
                    around[w].seen, all[w].doubtful & ~(around[w].seen | around[w].hidden)};
        }
    });
}

double ShadowEdges::doubtful_share(std::size_t samples) const {
    if (samples == 0) return 0.0;
    std::uint64_t doubtful = 0;
    for (const Word& word : of_patches_)
        doubtful += static_cast<std::uint64_t>(std::popcount(word.doubtful));
    const std::size_t rows = of_patches_.size() / words_;
    return static_cast<double>(doubtful) / static_cast<double>(rows * samples);
}

}  // namespace transillum
