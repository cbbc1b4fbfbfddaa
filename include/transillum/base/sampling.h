/// Low-discrepancy and pseudo-random numbers. Everything follows from a seed; nothing is global.
/// Sobol' direction numbers: Joe and Kuo 2008. Nested uniform scrambling (Owen 1995): every bit is
/// flipped by a hash of the seed, the dimension and the bits above it.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace transillum {

inline constexpr int sobol_dimensions = 8;

/// A bijective 64-bit mixer.
[[nodiscard]] std::uint64_t hash_bits(std::uint64_t x);

/// Owen-scrambled Sobol' sample in [0, 1). Any 2^k consecutive, 2^k-aligned indices form a net.
/// \param index sample; \param dimension in [0, sobol_dimensions)
[[nodiscard]] double sobol_owen(std::uint32_t index, int dimension, std::uint64_t seed);

/// Uniform direction from two numbers in [0, 1): z = 1 - 2u, equal area.
[[nodiscard]] glm::dvec3 uniform_direction(double u, double v);

/// Cosine-weighted direction about +z, z > 0.
[[nodiscard]] glm::dvec3 cosine_direction(double u, double v);

/// Right-handed orthonormal frame whose third column is the unit vector n.
[[nodiscard]] glm::dmat3 frame_about(const glm::dvec3& n);

/// Counter-based pseudo-random stream, one a (seed, stream) pair; cheap to create.
class Random {
public:
    Random(std::uint64_t seed, std::uint64_t stream);
    [[nodiscard]] std::uint32_t next_bits();
    /// Uniform in [0, 1).
    [[nodiscard]] double next();

private:
    std::uint64_t state_;
    std::uint64_t increment_;
};

}  // namespace transillum
