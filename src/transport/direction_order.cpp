#include "transport/direction_order.h"

#include <transillum/base/sampling.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace transillum {

std::uint64_t DirectionOrder::at(std::uint64_t i) {
    if (!shuffled_) return i;
    const std::uint64_t size = std::clamp(std::bit_floor(i), least_block, most_block);
    const std::uint64_t begin = i / size * size;
    if (block_.size() != size || begin_ != begin) {
        block_.resize(size);
        begin_ = begin;
        std::iota(block_.begin(), block_.end(), 0u);
        Random random(seed_, hash_bits(begin));
        for (std::size_t k = size; k > 1; --k)
            std::swap(block_[k - 1],
                      block_[static_cast<std::size_t>(random.next() * static_cast<double>(k))]);
    }
    return begin + block_[i - begin];
}

}  // namespace transillum
