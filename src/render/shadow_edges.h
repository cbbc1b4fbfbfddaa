/// Where shadow rays are needed: light samples that a patch and all around it see wholly, or not at
/// all, need none.
#pragma once

#include "render/vertex_grid.h"

#include <transillum/solution/solution.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace transillum {

class ShadowEdges {
public:
    ShadowEdges() = default;
    /// Nothing is known: every sample is doubtful to every patch.
    explicit ShadowEdges(const DirectLight& light);
    /// From visibilities that the first shot found. Patches that share a vertex within a shading
    /// fan are asked together: the first shot may have missed an edge within a pixel of its views.
    /// What a patch saw through fewer than two of those is doubtful.
    /// \pre the solution holds samples, not light vectors
    ShadowEdges(const Solution& solution, const VertexGrid& grid, const Workers& workers);

    /// A bit a sample: the lowest of word 0 is sample 0.
    static constexpr std::size_t samples_a_word = 64;
    [[nodiscard]] std::size_t words() const { return words_; }
    struct Word {
        std::uint64_t seen = 0;      ///< wholly
        std::uint64_t doubtful = 0;  ///< seen in part, somewhere about the patch
    };
    [[nodiscard]] const Word& at(std::uint32_t patch, std::size_t word) const {
        return of_patches_[patch * row_size_ + word];
    }
    /// Of the samples that light a patch, or may, all patches together. 0 where none does.
    [[nodiscard]] double doubtful_share() const;

private:
    std::size_t words_ = 0;
    std::size_t row_size_ = 0;  ///< 0: all patches share a row
    std::vector<Word> of_patches_;
};

}  // namespace transillum
