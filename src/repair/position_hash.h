/// Positions as keys.
#pragma once

#include <transillum/base/sampling.h>

#include <glm/vec3.hpp>

#include <bit>

namespace transillum {

struct PositionHash {
    std::size_t operator()(const glm::dvec3& p) const {
        const auto bits = [](double x) { return hash_bits(std::bit_cast<std::uint64_t>(x)); };
        return hash_bits(bits(p.x) ^ (bits(p.y) << 1) ^ (bits(p.z) << 2));
    }
};

}  // namespace transillum
