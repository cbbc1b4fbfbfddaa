#include <transillum/base/sampling.h>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace transillum {

namespace {

using DirectionNumbers = std::array<std::uint32_t, 32>;

/// A primitive polynomial over GF(2) and the first direction integers.
struct Polynomial {
    int degree;
    std::uint32_t coefficients;
    std::array<std::uint32_t, 5> m;
};

constexpr std::array<Polynomial, sobol_dimensions - 1> polynomials{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
}};

constexpr DirectionNumbers direction_numbers(int dimension) {
    DirectionNumbers v{};
    if (dimension == 0) {
        for (int i = 0; i < 32; ++i) v[i] = 1u << (31 - i);
        return v;
    }
    const Polynomial& p = polynomials[dimension - 1];
    for (int i = 0; i < p.degree; ++i) v[i] = p.m[i] << (31 - i);
    for (int i = p.degree; i < 32; ++i) {
        v[i] = v[i - p.degree] ^ (v[i - p.degree] >> p.degree);
        for (int k = 1; k < p.degree; ++k)
            if ((p.coefficients >> (p.degree - 1 - k)) & 1u) v[i] ^= v[i - k];
    }
    return v;
}

constexpr auto all_direction_numbers = [] {
    std::array<DirectionNumbers, sobol_dimensions> all{};
    for (int d = 0; d < sobol_dimensions; ++d) all[d] = direction_numbers(d);
    return all;
}();

std::uint32_t owen_scramble(std::uint32_t x, std::uint64_t key) {
    std::uint32_t flips = 0;
    for (int bit = 31; bit >= 0; --bit) {
        const std::uint64_t above = bit == 31 ? 0 : x >> (bit + 1);
        const std::uint64_t node = (std::uint64_t{1} << (31 - bit)) | above;
        flips |= static_cast<std::uint32_t>(hash_bits(key ^ node) >> 63) << bit;
    }
    return x ^ flips;
}

}  // namespace

std::uint64_t hash_bits(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

double sobol_owen(std::uint32_t index, int dimension, std::uint64_t seed) {
    if (dimension < 0 || dimension >= sobol_dimensions)
        throw std::out_of_range("sobol_owen: dimension outside [0, sobol_dimensions)");
    std::uint32_t x = 0;
    for (int i = 0; index != 0; index >>= 1, ++i)
        if (index & 1u) x ^= all_direction_numbers[dimension][i];
    const std::uint64_t key =
        hash_bits(seed ^ hash_bits(static_cast<std::uint64_t>(dimension) + 1));
    return (owen_scramble(x, key) + 0.5) * 0x1p-32;
}

glm::dvec3 uniform_direction(double u, double v) {
    const double z = 1.0 - 2.0 * u;
    const double r = std::sqrt(std::fmax(0.0, 1.0 - z * z));
    const double phi = 2.0 * std::numbers::pi * v;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

glm::dvec3 cosine_direction(double u, double v) {
    const double r = std::sqrt(u);
    const double phi = 2.0 * std::numbers::pi * v;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::fmax(0.0, 1.0 - u))};
}

glm::dmat3 frame_about(const glm::dvec3& n) {
    // Branch on the smallest component: the cross product is then never short.
    const glm::dvec3 a = glm::abs(n);
    const glm::dvec3 helper = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                              : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                       : glm::dvec3(0, 0, 1);
    const glm::dvec3 u = glm::normalize(glm::cross(helper, n));
    return {u, glm::cross(n, u), n};
}

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : state_(hash_bits(seed ^ hash_bits(stream))), increment_(hash_bits(stream + 1) | 1u) {}

// PCG-XSH-RR 64/32 (O'Neill 2014).
std::uint32_t Random::next_bits() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005u + increment_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto turn = static_cast<std::uint32_t>(old >> 59);
    return (shifted >> turn) | (shifted << ((32u - turn) & 31u));
}

double Random::next() {
    return next_bits() * 0x1p-32;
}

}  // namespace transillum
