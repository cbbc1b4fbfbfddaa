/// Low-discrepancy numbers for light paths: pairs of a scrambled Sobol' (0,2)-sequence, each pair
/// shuffled and scrambled on its own (Burley 2020, "Practical Hash-based Owen Scrambling"). Much
/// cheaper than sobol_owen, which is exact about every bit, and without its bound on dimensions.
#pragma once

#include <transillum/base/sampling.h>

#include <glm/vec2.hpp>

#include <cstdint>

namespace transillum {

class PixelSampler {
public:
    PixelSampler(std::uint64_t seed, std::uint64_t pixel, std::uint32_t sample)
        : state_(hash_bits(seed ^ hash_bits(pixel))), sample_(reverse_bits(sample)) {}

    /// The next two coordinates of the sample, in [0, 1).
    [[nodiscard]] glm::vec2 next_pair() {
        const std::uint64_t a = next_key(), b = next_key();
        const std::uint32_t index = reverse_bits(scramble(sample_, static_cast<std::uint32_t>(a)));
        const std::uint32_t x = scramble(index, static_cast<std::uint32_t>(a >> 32));
        const std::uint32_t y = scramble(second_dimension(index), static_cast<std::uint32_t>(b));
        return {to_unit(x), to_unit(y)};
    }
    [[nodiscard]] float next() { return next_pair().x; }

private:
    std::uint64_t next_key() { return state_ = hash_bits(state_); }

    static std::uint32_t reverse_bits(std::uint32_t x) {
        x = __builtin_bswap32(x);
        x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
        x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
        return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    }
    /// Owen scrambling of a bit-reversed number: each bit is flipped by those below it (Laine and
    /// Karras 2011).
    static std::uint32_t scramble(std::uint32_t x, std::uint32_t key) {
        x += key;
        x ^= x * 0x6c50b47cu;
        x ^= x * 0xb82f1e52u;
        x ^= x * 0xc7afe638u;
        x ^= x * 0x8d22f6e6u;
        return x;
    }
    /// Sobol's second dimension, bit-reversed: Pascal's triangle modulo 2, a Kronecker power of (1
    /// 1; 0 1).
    static std::uint32_t second_dimension(std::uint32_t index) {
        index ^= (index >> 1) & 0x55555555u;
        index ^= (index >> 2) & 0x33333333u;
        index ^= (index >> 4) & 0x0f0f0f0fu;
        index ^= (index >> 8) & 0x00ff00ffu;
        return index ^ (index >> 16);
    }
    static float to_unit(std::uint32_t reversed) {
        return static_cast<float>(reverse_bits(reversed) >> 8) * 0x1p-24f;
    }

    std::uint64_t state_;
    std::uint32_t sample_;
};

}  // namespace transillum
