/// The order in which directions of the low-discrepancy sequence are taken.
///
/// In turn where light is fed back as an average. Where it is carried from one bundle to the next,
/// directions that follow each other must know nothing of each other (design 4.5): there they are
/// shuffled within power-of-two blocks, after which the sequence is as even as ever.
#pragma once

#include <cstdint>
#include <vector>

namespace transillum {

class DirectionOrder {
public:
    explicit DirectionOrder(std::uint64_t seed) : seed_(seed) {}

    /// From the next block on.
    void shuffle() { shuffled_ = true; }
    void unshuffle() { shuffled_ = false; }
    /// Number in the sequence of the direction that is taken as number i. A run that was shuffled
    /// must be taken block by block.
    [[nodiscard]] std::uint64_t at(std::uint64_t i);

    /// A multiple of it begins every block from there on.
    static constexpr std::uint64_t least_block = 128, most_block = 1024;

private:
    std::uint64_t seed_;
    bool shuffled_ = false;
    std::uint64_t begin_ = 0;
    std::vector<std::uint32_t> block_;
};

}  // namespace transillum
