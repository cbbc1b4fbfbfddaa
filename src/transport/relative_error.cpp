#include "transport/relative_error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace transillum {

namespace {

/// Of how many octaves moves count: what comes before says little of now.
constexpr std::size_t most_moves = 4;
/// What is usual of a, and how sure that is; and of the logarithm of a move's mean square, whose
/// errors in space hang together.
constexpr double usual_a = 0.75, spread_of_a = 0.15, spread_of_moves = 0.4;
constexpr double least_a = 0.25, most_a = 1.25, step_of_a = 0.05;

double quiet_nan() {
    return std::numeric_limits<double>::quiet_NaN();
}

/// Shares that add up to `sum`.
std::vector<DirectionPart> with_sum(std::vector<DirectionPart> parts, double sum) {
    double all = 0.0;
    for (const DirectionPart& p : parts) all += p.share;
    for (DirectionPart& p : parts) p.share *= sum / all;
    return parts;
}

/// a less b. Parts of both begin alike.
std::vector<DirectionPart> difference(const std::vector<DirectionPart>& a,
                                      const std::vector<DirectionPart>& b) {
    std::vector<DirectionPart> result = with_sum(a, 1.0);
    for (const DirectionPart& p : with_sum(b, -1.0)) {
        const auto same = std::find_if(result.begin(), result.end(),
                                       [&](const auto& r) { return r.begin == p.begin; });
        if (same == result.end())
            result.push_back(p);
        else
            same->share += p.share;
    }
    std::sort(result.begin(), result.end(),
              [](const auto& p, const auto& q) { return p.begin < q.begin; });
    return result;
}

}  // namespace

double variance_of_parts(std::span<const DirectionPart> parts, double a) {
    std::array<double, 65> of_net;  // by the power of two of directions
    for (std::size_t k = 0; k < of_net.size(); ++k)
        of_net[k] = std::exp2(-2.0 * a * static_cast<double>(k));
    const double between = 2.0 - std::exp2(2.0 * a);
    double sum = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const DirectionPart& p = parts[i];
        sum += p.share * p.share * std::pow(static_cast<double>(p.end - p.begin), -2.0 * a);
        for (std::size_t j = 0; j < i; ++j) {
            const auto net = static_cast<std::size_t>(std::bit_width(parts[j].begin ^ (p.end - 1)));
            sum += 2.0 * p.share * parts[j].share * between * of_net[net];
        }
    }
    return sum;
}

ErrorModel fit_error_model(std::span<const AverageMove> moves) {
    ErrorModel best;
    double least = std::numeric_limits<double>::infinity();
    // Logarithms of ratios: sources twice as bright change no bit of what is told.
    const double unit = moves.front().mean_square;
    for (double a = least_a; a < most_a + 0.5 * step_of_a; a += step_of_a) {
        double mean = 0.0, square = 0.0;
        for (const AverageMove& m : moves) {
            const double x = std::log(m.mean_square / unit / variance_of_parts(m.difference, a));
            mean += x;
            square += x * x;
        }
        const auto n = static_cast<double>(moves.size());
        mean /= n;
        const double misfit = (square - n * mean * mean) / (spread_of_moves * spread_of_moves) +
                              std::pow((a - usual_a) / spread_of_a, 2.0);
        if (misfit < least) {
            least = misfit;
            best = {unit * std::exp(mean), a};
        }
    }
    return best;
}

void ErrorEstimate::add(std::uint64_t begin, std::uint64_t end, double weight) {
    const double share = weight * static_cast<double>(end - begin);
    const std::uint64_t quarter = std::max<std::uint64_t>(1, std::bit_floor(begin) / 4);
    if (!now_.parts.empty() && now_.parts.back().end == begin && begin % quarter != 0) {
        now_.parts.back().end = end;
        now_.parts.back().share += share;
    } else {
        now_.parts.push_back({begin, end, share});
    }
}

void ErrorEstimate::restart() {
    now_.earlier = std::move(now_.parts);
    now_.parts.clear();
}

std::vector<DirectionPart> ErrorHistory::concluded() const {
    std::vector<DirectionPart> all = earlier;
    all.insert(all.end(), parts.begin(), parts.end());
    return all;
}

void ErrorEstimate::recall() {
    now_.parts = now_.concluded();
    now_.earlier.clear();
}

void ErrorEstimate::compare(const FiniteElementComponent& component) {
    std::vector<float> seen(component.patch_count());
    struct Move {
        double area = 0.0, square = 0.0;
    };
    const auto compare_patch = [&](Move& move, std::size_t i) {
        const auto p = static_cast<std::uint32_t>(i);
        seen[p] = component.coverage(p) > 0.0 ? static_cast<float>(luminance(component.incoming(p)))
                                              : -1.0f;
        if (now_.last.empty() || now_.last[p] < 0.0f || seen[p] < 0.0f || !component.reflects(p))
            return;
        const double area = leaf_area_[p % leaf_area_.size()];
        move.area += area;
        move.square += area * std::pow(double{seen[p]} - double{now_.last[p]}, 2.0);
    };
    const Move move =
        fold(workers_, seen.size(), Move{}, compare_patch, [](Move& m, const Move& n) {
            m.area += n.area;
            m.square += n.square;
        });
    if (!now_.last.empty()) {
        if (now_.moves.size() == most_moves || (now_.moves.size() == 1 && now_.jumps)) {
            now_.moves.erase(now_.moves.begin());
            now_.jumps = false;
        }
        now_.moves.push_back({difference(now_.parts, now_.last_parts),
                              move.area > 0.0 ? move.square / move.area : 0.0});
        const bool moved = std::all_of(now_.moves.begin(), now_.moves.end(),
                                       [](const AverageMove& m) { return m.mean_square > 0.0; });
        now_.model = moved ? fit_error_model(now_.moves) : ErrorModel{};
    }
    now_.last = std::move(seen);
    now_.last_parts = now_.parts;
}

void ErrorEstimate::begin_anew(const FiniteElementComponent& component) {
    now_.moves.clear();
    now_.last.clear();
    compare(component);
    now_.jumps = true;
}

double ErrorEstimate::variance() const {
    if (now_.moves.empty() || now_.parts.empty()) return quiet_nan();
    const std::vector<DirectionPart> parts = with_sum(now_.concluded(), 1.0);
    // Parts that are no nets, at the end of a run, may seem to do better than all together could.
    const double net = std::pow(static_cast<double>(parts.back().end), -2.0 * now_.model.a);
    return now_.model.c * std::max(net, variance_of_parts(parts, now_.model.a));
}

ErrorEstimate::Sums ErrorEstimate::measure(const FiniteElementComponent& component) const {
    const auto measure_patch = [&](Sums& sums, std::size_t i) {
        const auto p = static_cast<std::uint32_t>(i);
        if (!component.reflects(p)) return;
        const double area = leaf_area_[p % leaf_area_.size()];
        sums.all += area;
        if (component.coverage(p) == 0.0) return;
        sums.seen += area;
        sums.mean += area * luminance(component.incoming(p));
        const SpectrumSum variance = component.incoming_variance(p);
        if (!is_finite(variance)) return;
        sums.told += area;
        sums.variance += area * luminance(variance);
    };
    return fold(workers_, component.patch_count(), Sums{}, measure_patch,
                [](Sums& s, const Sums& t) {
                    s.variance += t.variance;
                    s.mean += t.mean;
                    s.seen += t.seen;
                    s.told += t.told;
                    s.all += t.all;
                });
}

double ErrorEstimate::relative_error(const FiniteElementComponent& component) const {
    const Sums all = measure(component);
    if (all.seen == 0.0) return quiet_nan();
    if (all.mean == 0.0) return 0.0;
    // Of a patch that hardly any direction has met nothing is known: an error as large as the mean.
    const double mean = all.mean / all.seen;
    return std::sqrt((all.told * variance() + (all.all - all.told) * mean * mean) / all.all) / mean;
}

double ErrorEstimate::uncertainty() const {
    return 0.5 * spread_of_moves / std::sqrt(static_cast<double>(now_.moves.size()));
}

double ErrorEstimate::correction(const FiniteElementComponent& component) const {
    const Sums all = measure(component);
    const double factor = all.told * variance() / all.variance;
    return std::isfinite(factor) ? factor : 1.0;
}

}  // namespace transillum
