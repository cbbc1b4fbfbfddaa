/// How much the Monte-Carlo component changes what patches receive: whether it is worth its cost.
#pragma once

#include "transport/exchange.h"
#include "transport/monte_carlo_component.h"

#include <array>
#include <span>
#include <vector>

namespace transillum {

/// Measured over two sets of directions. What both have in common is the effect; the rest is noise,
/// which a product of the two leaves out in the mean.
class ResidualEffect {
public:
    explicit ResidualEffect(std::uint32_t leaf_count)
        : leaf_count_(leaf_count),
          elements_(2 * std::size_t{leaf_count}),
          halves_(2 * std::size_t{leaf_count}) {}

    /// After every direction: what the finite elements sent.
    void add(const MonteCarloComponent& residual, const Workers& workers);
    /// After every block: all that a patch received. Different patches may be taken at once.
    void take(std::uint32_t patch, const Received& all);
    void begin_second_half() { half_ = 1; }

    /// Root mean square, weighted with area, of the luminance that comes with the component, over
    /// the area of all patches [W sr^-1 m^-2]. \param leaf_area one a leaf
    [[nodiscard]] double root_mean_square(std::span<const double> leaf_area) const;

private:
    struct Half {
        double residual = 0.0, coverage = 0.0;
    };
    std::uint32_t leaf_count_;
    int half_ = 0;
    std::vector<double> elements_;  ///< one a patch: luminance times coverage, in this block
    std::vector<std::array<Half, 2>> halves_;
};

}  // namespace transillum
