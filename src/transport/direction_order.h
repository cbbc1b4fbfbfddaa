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

    /// Those from number `next` on.
    void shuffle(std::uint64_t next);
    /// As soon as the block that number `next` is in is through.
    void unshuffle(std::uint64_t next);
    /// Those that are shuffled: what another of the same seed needs to be in the same order.
    struct Range {
        std::uint64_t from = 0, until = 0;
    };
    [[nodiscard]] Range shuffled() const { return {from_, until_}; }
    void set_shuffled(const Range& range) {
        from_ = range.from;
        until_ = range.until;
    }
    /// Number in the sequence of the direction that is taken as number i.
    [[nodiscard]] std::uint64_t at(std::uint64_t i);

    /// Are those before number `next` the first of the sequence, too?
    [[nodiscard]] bool is_even(std::uint64_t next) const;

    /// A multiple of it begins every block from there on.
    static constexpr std::uint64_t least_block = 128, most_block = 1024;

private:
    std::uint64_t seed_;
    std::uint64_t from_ = 0, until_ = 0;  ///< shuffled
    std::uint64_t begin_ = 0;             ///< of the block at hand
    std::vector<std::uint32_t> block_;
};

}  // namespace transillum
