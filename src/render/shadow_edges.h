/// Where shadow rays are needed: light samples that a patch and all around it see wholly, or not at
/// all, need none.
#pragma once

#include "render/vertex_grid.h"

#include <transillum/first_shot/direct_light.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace transillum {

class ShadowEdges {
public:
    ShadowEdges() = default;
    /// Nothing is known: every sample is doubtful to every patch.
    explicit ShadowEdges(const DirectLight& light);
    /// From visibilities that the first shot found. An edge within a pixel of its views may have
    /// been missed by a patch, which is why its neighbours are asked, too.
    /// \pre light holds samples, not light vectors
    ShadowEdges(const DirectLight& light, const PatchHierarchy& patches, const VertexGrid& grid,
                const Workers& workers);

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
    /// Mean over patches of the share of samples that are doubtful.
    [[nodiscard]] double doubtful_share(std::size_t samples) const;

private:
    std::size_t words_ = 0;
    std::size_t row_size_ = 0;  ///< 0: all patches share a row
    std::vector<Word> of_patches_;
};

}  // namespace transillum
