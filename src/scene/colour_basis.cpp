// A quadratic program: least sum of squared differences, under equations, nothing negative. Solved
// by the primal-dual active set method (Hintermueller, Ito and Kunisch 2002): the values at zero
// are guessed, the equations of the optimum solved for all others, and the guess corrected by the
// signs of values and multipliers until it stands.
#include "scene/colour_basis.h"

#include <transillum/base/error.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace transillum {

namespace {

constexpr int most_corrections = 200;

/// Dense, row by row.
struct Matrix {
    explicit Matrix(std::size_t size_) : size(size_), values(size_ * size_) {}
    double& operator()(std::size_t row, std::size_t column) { return values[row * size + column]; }
    std::size_t size;
    std::vector<double> values;
};

/// By elimination, the largest pivot of a column first.
std::vector<double> solve(Matrix m, std::vector<double> x) {
    const std::size_t n = m.size;
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(m(i, k)) > std::abs(m(pivot, k))) pivot = i;
        for (std::size_t j = k; j < n && pivot != k; ++j) std::swap(m(k, j), m(pivot, j));
        std::swap(x[k], x[pivot]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = m(i, k) / m(k, k);
            if (factor == 0.0) continue;
            for (std::size_t j = k; j < n; ++j) m(i, j) -= factor * m(k, j);
            x[i] -= factor * x[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) x[k] -= m(k, j) * x[j];
        x[k] /= m(k, k);
    }
    return x;
}

class Program {
public:
    explicit Program(const std::vector<glm::dvec3>& rgb_of_band)
        : rgb_(rgb_of_band), bands_(rgb_of_band.size()), at_zero_(3 * bands_) {}

    std::vector<glm::dvec3> solve_it() {
        for (int i = 0; i < most_corrections; ++i) {
            find_optimum();
            if (!correct_guess()) return shares();
        }
        throw Error("no spectra of " + std::to_string(bands_) +
                    " bands give the primaries of sRGB back");
    }

private:
    // Values: primary by primary. Equations: a band's shares make 1; the colours of red and green
    // (that of blue follows).
    [[nodiscard]] std::size_t value(std::size_t primary, std::size_t band) const {
        return primary * bands_ + band;
    }
    [[nodiscard]] std::size_t equation(std::size_t primary, std::size_t channel) const {
        return 4 * bands_ + 3 * primary + channel;
    }

    void find_optimum() {
        const std::size_t size = 4 * bands_ + 6;
        Matrix m(size);
        std::vector<double> right(size);
        const auto couple = [&](std::size_t row, std::size_t column, double factor) {
            m(row, column) += factor;
            m(column, row) += factor;
        };
        for (std::size_t p = 0; p < 3; ++p)
            for (std::size_t b = 0; b < bands_; ++b) {
                if (b + 1 < bands_) {
                    m(value(p, b), value(p, b)) += 1.0;
                    m(value(p, b + 1), value(p, b + 1)) += 1.0;
                    couple(value(p, b), value(p, b + 1), -1.0);
                }
                couple(3 * bands_ + b, value(p, b), 1.0);
                right[3 * bands_ + b] = 1.0;
                for (std::size_t c = 0; c < 3 && p < 2; ++c) {
                    couple(equation(p, c), value(p, b), rgb_[b][static_cast<int>(c)]);
                    right[equation(p, c)] = p == c ? 1.0 : 0.0;
                }
            }
        Matrix fixed = m;
        for (std::size_t i = 0; i < at_zero_.size(); ++i) {
            if (!at_zero_[i]) continue;
            for (std::size_t j = 0; j < size; ++j) fixed(i, j) = i == j ? 1.0 : 0.0;
        }
        optimum_ = solve(fixed, right);
        slope_.assign(at_zero_.size(), 0.0);
        for (std::size_t i = 0; i < at_zero_.size(); ++i)
            for (std::size_t j = 0; j < size; ++j) slope_[i] += m(i, j) * optimum_[j];
    }

    /// False where it was right.
    bool correct_guess() {
        bool changed = false;
        for (std::size_t i = 0; i < at_zero_.size(); ++i) {
            const bool better_at_zero = at_zero_[i] ? slope_[i] > -1e-12 : optimum_[i] < -1e-12;
            changed = changed || better_at_zero != at_zero_[i];
            at_zero_[i] = better_at_zero;
        }
        return changed;
    }

    [[nodiscard]] std::vector<glm::dvec3> shares() const {
        std::vector<glm::dvec3> result;
        for (std::size_t b = 0; b < bands_; ++b)
            result.push_back(glm::max(
                glm::dvec3(optimum_[value(0, b)], optimum_[value(1, b)], optimum_[value(2, b)]),
                glm::dvec3(0.0)));
        return result;
    }

    const std::vector<glm::dvec3>& rgb_;
    std::size_t bands_;
    std::vector<bool> at_zero_;
    std::vector<double> optimum_, slope_;
};

}  // namespace

std::vector<glm::dvec3> find_colour_basis(const std::vector<glm::dvec3>& rgb_of_band) {
    return Program(rgb_of_band).solve_it();
}

}  // namespace transillum
