#include "transport/direction_order.h"

#include <transillum/base/sampling.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

namespace transillum {

namespace {

/// The block that a number is in.
std::pair<std::uint64_t, std::uint64_t> block_of(std::uint64_t i) {
    const std::uint64_t size =
        std::clamp(std::bit_floor(i), DirectionOrder::least_block, DirectionOrder::most_block);
    return {i / size * size, i / size * size + size};
}

}  // namespace

void DirectionOrder::shuffle(std::uint64_t next) {
    from_ = next;
    until_ = std::numeric_limits<std::uint64_t>::max();
}

void DirectionOrder::unshuffle(std::uint64_t next) {
    const auto [begin, end] = block_of(next);
    until_ = begin == next ? begin : end;
}

bool DirectionOrder::is_even(std::uint64_t next) const {
    return next <= from_ || next >= until_ || block_of(next).first == next;
}

std::uint64_t DirectionOrder::at(std::uint64_t i) {
    if (i < from_ || i >= until_) return i;
    auto [begin, end] = block_of(i);
    begin = std::max(begin, from_);
    if (begin_ != begin || block_.size() != end - begin) {
        begin_ = begin;
        block_.resize(end - begin);
        std::iota(block_.begin(), block_.end(), 0u);
        Random random(seed_, hash_bits(begin));
        for (std::size_t k = block_.size(); k > 1; --k)
            std::swap(block_[k - 1],
                      block_[static_cast<std::size_t>(random.next() * static_cast<double>(k))]);
    }
    return begin + block_[i - begin];
}

}  // namespace transillum
