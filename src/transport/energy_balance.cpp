#include "transport/energy_balance.h"

#include <transillum/base/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace transillum {

namespace {

/// A cluster met less often is left as it is: shares of so few fragments say nothing.
constexpr double least_fragments = 64.0;
/// Likewise one that light met less often, of which transfers are a sample: only some rows of
/// pixels, and none from before the last restart.
constexpr double least_lit_fragments = 8.0 * least_fragments;
/// Of its cluster's mean, below which a patch does not take that for its own.
constexpr double least_share = 1.0 / 16.0;
/// No balance scales by more than this at once.
constexpr double largest_factor = 32.0;

/// Means over a cluster's patches, weighted with their coverage.
struct ClusterState {
    double coverage = 0.0;
    SpectrumSum incoming{0.0};  ///< sums until divided by coverage
    SpectrumSum reflected{0.0};
    SpectrumSum source{0.0};
    SpectrumSum albedo{0.0};
    // Sums over the patches' fragments of what arrived, and of its square.
    SpectrumSum arrived{0.0}, arrived_squared{0.0};

    /// As many fragments that bring light alike would tell as much.
    [[nodiscard]] double lit_fragments(int channel) const {
        const double squared = arrived_squared[channel];
        return squared > 0.0 ? arrived[channel] * arrived[channel] / squared : 0.0;
    }
    ClusterState& operator+=(const ClusterState& other) {
        coverage += other.coverage;
        incoming += other.incoming;
        reflected += other.reflected;
        source += other.source;
        albedo += other.albedo;
        arrived += other.arrived;
        arrived_squared += other.arrived_squared;
        return *this;
    }
};
using ClusterStates = std::vector<ClusterState>;

ClusterStates measure_clusters(const FiniteElementComponent& component, const Clusters& clusters,
                               const Workers& workers) {
    const auto measure_patch = [&](ClusterStates& states, std::size_t i) {
        const auto p = static_cast<std::uint32_t>(i);
        const double c = component.coverage(p);
        if (c == 0.0) return;
        ClusterState& s = states[clusters.of_patch[p]];
        s.coverage += c;
        const SpectrumSum incoming = component.incoming(p);
        s.incoming += c * incoming;
        s.arrived += component.fragments(p) * incoming;
        s.arrived_squared += component.fragments(p) * incoming * incoming;
        s.reflected += c * component.reflected(p);
        s.source += c * component.source(p);
        s.albedo += c * component.mean_albedo(p);
    };
    return fold(workers, component.patch_count(), ClusterStates(clusters.count), measure_patch,
                [](ClusterStates& all, const ClusterStates& part) {
                    for (std::size_t i = 0; i < all.size(); ++i) all[i] += part[i];
                });
}

/// Square system with a unit diagonal less something non-negative, columns summing to at least 0:
/// elimination without pivoting is stable. Row-major, augmented with the right-hand side. \returns
/// false when singular: a pivot is lost to cancellation.
bool solve(std::vector<double>& a, std::uint32_t n, std::vector<double>& x) {
    const std::uint32_t width = n + 1;
    const double least = 64.0 * n * std::numeric_limits<double>::epsilon();
    for (std::uint32_t k = 0; k < n; ++k) {
        if (!(a[k * width + k] > least)) return false;
        for (std::uint32_t i = k + 1; i < n; ++i) {
            const double f = a[i * width + k] / a[k * width + k];
            if (f == 0.0) continue;
            for (std::uint32_t j = k; j < width; ++j) a[i * width + j] -= f * a[k * width + j];
        }
    }
    x.assign(n, 0.0);
    for (std::uint32_t i = n; i-- > 0;) {
        double sum = a[i * width + n];
        for (std::uint32_t j = i + 1; j < n; ++j) sum -= a[i * width + j] * x[j];
        x[i] = sum / a[i * width + i];
    }
    return true;
}

/// Mean incoming radiance of every cluster in balance, in one channel.
std::vector<double> solve_channel(const ClusterStates& states, const ClusterTransfer& transfer,
                                  BalanceShape shape, int channel) {
    const std::uint32_t n = transfer.count;
    // Residuals have signs. Where they outweigh all else, between clusters that hardly see each
    // other, next to nothing is received.
    const auto received = [&](std::uint32_t i, std::uint32_t j) {
        return std::max(0.0, transfer.at(i, j).radiance[channel]);
    };
    std::vector<double> sent(n), seen(n);
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            sent[j] += received(i, j);
            seen[j] += transfer.at(i, j).coverage;
        }
    // Share of j's flux that reaches i; a dark cluster's by its fragments.
    const auto share = [&](std::uint32_t i, std::uint32_t j) {
        if (seen[j] == 0.0) return 0.0;
        if (shape == BalanceShape::flat || sent[j] == 0.0)
            return transfer.at(i, j).coverage / seen[j];
        return received(i, j) / sent[j];
    };
    std::vector<double> matrix(std::size_t{n} * (n + 1)), flux;
    for (std::uint32_t i = 0; i < n; ++i) {
        const ClusterState& s = states[i];
        const bool flat = shape == BalanceShape::flat || s.incoming[channel] == 0.0;
        const double albedo = s.coverage == 0.0 ? 0.0
                              : flat            ? s.albedo[channel] / s.coverage
                                                : s.reflected[channel] / s.incoming[channel];
        for (std::uint32_t j = 0; j < n; ++j)
            matrix[i * (n + 1) + j] = (i == j ? 1.0 : 0.0) - albedo * share(i, j);
        matrix[i * (n + 1) + n] = s.coverage == 0.0
                                      ? 0.0
                                      : seen[i] * s.source[channel] / s.coverage +
                                            albedo * transfer.at(i, n).radiance[channel];
    }
    if (!solve(matrix, n, flux))
        throw UsageError(
            "max albedo: no surface absorbs light of channel " + std::to_string(channel) +
            " and none leaves the scene, so it would never fade; accepted: a lower maximum");
    std::vector<double> incoming(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        incoming[i] = transfer.at(i, n).radiance[channel];
        for (std::uint32_t j = 0; j < n; ++j) incoming[i] += share(i, j) * flux[j];
        if (seen[i] > 0.0) incoming[i] /= seen[i];
    }
    return incoming;
}

/// As much of a factor as leaves what arrives below the bound.
SpectrumSum limited(const SpectrumSum& factor, const SpectrumSum& incoming,
                    const SpectrumSum& bound) {
    SpectrumSum f = factor;
    for (int c = 0; c < channel_count; ++c)
        if (f[c] > 1.0 && f[c] * incoming[c] > bound[c])
            f[c] = std::max(1.0, bound[c] / incoming[c]);
    return f;
}

}  // namespace

SpectrumSum largest_incoming(const FiniteElementComponent& component, float brightest_environment,
                             const Workers& workers) {
    const SpectrumSum unbounded(std::numeric_limits<double>::infinity());
    if (component.is_glossy()) return unbounded;
    struct Largest {
        SpectrumSum source{0.0}, albedo{0.0};
    };
    const Largest largest = fold(
        workers, component.patch_count(), Largest{SpectrumSum(brightest_environment)},
        [&](Largest& l, std::size_t i) {
            const auto p = static_cast<std::uint32_t>(i);
            l.source = glm::max(l.source, component.source(p));
            l.albedo = glm::max(l.albedo, component.mean_albedo(p));
        },
        [](Largest& l, const Largest& other) {
            l.source = glm::max(l.source, other.source);
            l.albedo = glm::max(l.albedo, other.albedo);
        });
    return glm::mix(largest.source / (1.0 - largest.albedo), unbounded,
                    glm::greaterThanEqual(largest.albedo, SpectrumSum(1.0)));
}

void balance_energy(FiniteElementComponent& component, const Clusters& clusters,
                    const ClusterTransfer& transfer, BalanceShape shape,
                    float brightest_environment, const Workers& workers) {
    const ClusterStates states = measure_clusters(component, clusters, workers);
    std::vector<double> fragments(clusters.count);
    for (std::uint32_t j = 0; j < clusters.count; ++j)
        for (std::uint32_t i = 0; i <= clusters.count; ++i)
            fragments[j] += transfer.at(i, j).coverage;
    std::vector<SpectrumSum> target(clusters.count), factor(clusters.count, SpectrumSum(1.0));
    for (int channel = 0; channel < channel_count; ++channel) {
        const std::vector<double> incoming = solve_channel(states, transfer, shape, channel);
        for (std::uint32_t i = 0; i < clusters.count; ++i) {
            target[i][channel] = incoming[i];
            if (fragments[i] < least_fragments) continue;
            const double now =
                states[i].coverage > 0.0 ? states[i].incoming[channel] / states[i].coverage : 0.0;
            const bool is_told = states[i].lit_fragments(channel) >= least_lit_fragments;
            if (is_told && now > 0.0 && incoming[i] > 0.0)
                factor[i][channel] =
                    std::clamp(incoming[i] / now, 1.0 / largest_factor, largest_factor);
        }
    }
    const SpectrumSum bound = largest_incoming(component, brightest_environment, workers);
    const auto scale_patch = [&](std::uint32_t p) {
        const std::uint32_t i = clusters.of_patch[p];
        if (shape == BalanceShape::kept) {
            component.scale_incoming(p, limited(factor[i], component.incoming(p), bound));
            return;
        }
        if (fragments[i] < least_fragments) return;
        // What hardly any light has reached stays dark: it may be sealed off from the rest of its
        // cluster but for a leak, and such a place would forget its start slowly.
        const SpectrumSum own = component.incoming(p);
        const SpectrumSum least = least_share * states[i].incoming / states[i].coverage;
        const SpectrumSum reached(glm::greaterThan(own, least));
        component.set_incoming(p, glm::mix(own * factor[i], target[i], reached));
    };
    constexpr std::size_t grain = 16384;
    workers.for_ranges(component.patch_count(), grain,
                       [&](std::size_t begin, std::size_t end, int) {
                           for (std::size_t p = begin; p < end; ++p)
                               scale_patch(static_cast<std::uint32_t>(p));
                       });
}

}  // namespace transillum
