#include "physics/stability/measure.h"

#include "support/scene_builder.h"

#include <transillum/scene/brdf.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <exception>
#include <numbers>
#include <span>

namespace transillum::stability {

namespace {

/// Roundings of floats between a source and a radiance, by reflection.
constexpr double roundings = 16.0;
/// By how many of them a radiance may be above its bound where a first shot adds to it: each of two
/// estimates is bounded, but not what their errors add up to.
constexpr float standard_errors = 4.0f;
/// Patches with fewer may not have been met before all else was known. Until the block in which
/// they first are ends, they send too little: it is a quarter of all there were, and brings as
/// many fragments more.
constexpr float few_fragments = 16.0f;
constexpr double fragments_of_first_block = 1.25;
/// More seeds, up to so many, are baked where energy may be off by more than this.
constexpr double well_known = 0.01;
constexpr int most_seeds = 16;

double rounding_of(const Condition& condition) {
    return roundings * 0x1p-24 / (1.0 - condition.albedo);
}

/// Student's t for a mean of n values that is further from 0 by chance once in a thousand times.
double student_t(std::size_t n) {
    constexpr std::array t{636.6, 31.6, 12.92, 8.61, 6.87, 5.96, 5.41, 5.04,
                           4.78,  4.59, 4.44,  4.32, 4.22, 4.14, 4.07};
    static_assert(t.size() == most_seeds - 1);
    return t.at(n - 2);
}

Deviation sampled(const std::vector<double>& values, double rounding) {
    const auto n = static_cast<double>(values.size());
    double mean = 0.0, square = 0.0;
    for (const double v : values) mean += v / n;
    for (const double v : values) square += (v - mean) * (v - mean) / (n - 1.0);
    return {mean, rounding + student_t(values.size()) * std::sqrt(square / n)};
}

Deviation exact(const std::vector<double>& values, double rounding) {
    const auto furthest = [](double a, double b) { return std::abs(a) < std::abs(b); };
    return {*std::ranges::max_element(values, furthest), rounding};
}

/// Of the worst channel. One that has no light is to have none anywhere.
double energy_error(const EnergyBalance& b) {
    double worst = 0.0;
    for (int c = 0; c < channel_count; ++c) {
        const double there_is = b.emitted[c] + b.entered[c];
        const double went = b.absorbed[c] + b.escaped[c] + b.black_backs[c];
        const double error = there_is > 0.0 ? went / there_is - 1.0
                             : went == 0.0  ? 0.0
                                            : std::numeric_limits<double>::infinity();
        if (!(std::abs(error) <= std::abs(worst))) worst = error;
    }
    return worst;
}

/// Emission, what comes from outside, and what reflects the light of lights without extent.
double largest_source(const Solution& s) {
    float largest = 0.0f;
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        const bool lit = !s.lighting.lights.empty();
        const Spectrum direct = lit ? s.direct_radiance(p) : Spectrum(0.0f);
        largest = std::max(largest, max_channel(s.emission(p) + direct));
    }
    if (s.lighting.environment.shines())
        largest = std::max(largest, max_channel(s.lighting.environment.radiance_scale));
    return largest;
}

/// The share that a material reflects of light from any angle.
double largest_albedo(const Material& m) {
    constexpr int angles = 64;
    const Brdf brdf = brdf_of(m);
    if (brdf.lobe == Lobe::none) return max_channel(m.diffuse);
    float largest = 0.0f;
    for (int i = 1; i <= angles; ++i)
        largest = std::max(largest, max_channel(directional_albedo(
                                        brdf, static_cast<float>(i) / static_cast<float>(angles))));
    return largest;
}

double largest_albedo(const Solution& s) {
    double largest = 0.0;
    for (const Material& m : s.surface.materials) largest = std::max(largest, largest_albedo(m));
    return largest;
}

class Judge {
public:
    Judge(const Condition& condition, Row& row) : condition_(condition), row_(row) {}

    void look_at(const Solution& s) {
        row_.leaves = s.patches.leaf_count;
        row_.directions = s.iterations;
        energy_.push_back(energy_error(s.balance));
        if (condition_.closed_form.error) closed_form_.push_back(condition_.closed_form.error(s));
        look_at_radiance(s);
        look_at_coverage(s);
        require_finite("indirect irradiance", s.indirect_irradiance);
        require_finite("direct irradiance", s.direct_irradiance);
        require_finite("standard error", s.standard_error);
        require_finite("glossy elements", s.glossy_elements);
        require_finite("V_s", s.spatial_error);
        require_finite("V_d", s.directional_error);
        require_finite("coverage", s.coverage);
        const std::array<SpectrumSum, 5> balance{s.balance.emitted, s.balance.entered,
                                                 s.balance.absorbed, s.balance.escaped,
                                                 s.balance.black_backs};
        require_finite("energy balance", balance);
        require_finite("relative error", std::array{s.relative_error});
    }

    /// Do the seeds so far differ too much to tell whether energy is balanced?
    [[nodiscard]] bool needs_another() const {
        return condition_.is_balanced && row_.seeds < most_seeds &&
               sampled(energy_, 0.0).allowed > well_known;
    }

    void conclude() {
        row_.energy = energy();
        if (row_.is_balanced) {
            require_near_zero("energy", row_.energy);
            if (row_.energy.allowed >= 1.0) fault("energy: seeds differ by as much as there is");
        }
        row_.has_closed_form = !closed_form_.empty();
        if (row_.has_closed_form) {
            const double allowed = rounding_of(condition_) + too_little() + rarely_met_;
            row_.closed_form = condition_.closed_form.is_sampled ? sampled(closed_form_, allowed)
                                                                 : exact(closed_form_, allowed);
            require_near_zero("closed form", row_.closed_form);
        }
        if (!(row_.least >= 0.0)) fault(fmt::format("a radiance is {}", row_.least));
    }

    void fault(std::string what) {
        if (std::ranges::find(row_.faults, what) == row_.faults.end())
            row_.faults.push_back(std::move(what));
    }

private:
    [[nodiscard]] Deviation energy() const {
        return sampled(energy_, rounding_of(condition_) + unseen_energy_ + too_little());
    }
    /// Bound of the share that all else misses of what is reflected by patches that few met.
    [[nodiscard]] double too_little() const { return rare_ / (1.0 - condition_.albedo); }

    void look_at_radiance(const Solution& s) {
        const double bound = largest_source(s) / (1.0 - largest_albedo(s));
        const double rounded_bound = bound * (1.0 + rounding_of(condition_));
        const float adding = s.direct.samples.empty() ? 0.0f : standard_errors;
        const auto compare = [&](const Spectrum& radiance, const Spectrum& error) {
            for (int c = 0; c < channel_count; ++c) {
                row_.least = std::min<double>(row_.least, radiance[c]);
                row_.most_over_bound = std::max<double>(row_.most_over_bound, radiance[c] / bound);
                if (!(radiance[c] <= rounded_bound + adding * error[c]))
                    fault("a radiance is above its bound");
            }
        };
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p)
            compare(s.emission(p) + s.direct_radiance(p) + s.finite_element_radiance(p),
                    s.standard_error[p]);
        for (const Spectrum& radiance : s.glossy_elements) compare(radiance, Spectrum(0.0f));
    }

    /// What no direction met, and what few did.
    void look_at_coverage(const Solution& s) {
        double area = 0.0, unseen = 0.0, absorbing = 0.0, unseen_absorbing = 0.0;
        double fragments = 0.0, rare = 0.0, rarely_met = 0.0;
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
            const double a = area_of_leaf(s.surface, s.patches, s.patches.leaf_of_patch(p));
            const double absorbed = s.reflects(p) ? a * (1.0 - mean_channel(s.diffuse(p))) : 0.0;
            area += a;
            absorbing += absorbed;
            fragments += s.coverage[p];
            if (s.coverage[p] > 0.0f) {
                if (s.coverage[p] < few_fragments) {
                    rare += fragments_of_first_block;
                    rarely_met += s.coverage[p];
                }
                continue;
            }
            unseen += a;
            unseen_absorbing += absorbed;
        }
        row_.unseen = std::max(row_.unseen, unseen / area);
        unseen_energy_ = std::max(unseen_energy_, unseen_absorbing / absorbing);
        rare_ = std::max(rare_, rare / fragments);
        rarely_met_ = std::max(rarely_met_, rarely_met / fragments);
    }

    static bool finite(double x) { return std::isfinite(x); }
    static bool finite(const Spectrum& s) { return is_finite(s); }
    static bool finite(const SpectrumSum& s) { return is_finite(s); }
    template <class Values>
    void require_finite(const char* what, const Values& values) {
        for (const auto& value : values)
            if (!finite(value)) return fault(fmt::format("{}: not all finite", what));
    }

    void require_near_zero(const char* what, const Deviation& d) {
        if (!(std::abs(d.mean) <= d.allowed))
            fault(fmt::format("{}: off by {:.2e}, allowed {:.2e}", what, d.mean, d.allowed));
    }

    const Condition& condition_;
    Row& row_;
    std::vector<double> energy_, closed_form_;
    double unseen_energy_ = 0.0;  ///< share that is missing in patches that no direction met
    // Of patches that few did, as shares of all fragments: those that met them first, and all,
    // which may leave them themselves off by as much as there is.
    double rare_ = 0.0, rarely_met_ = 0.0;
};

}  // namespace

Row measure(const Condition& condition, const Effort& effort, const Workers& workers) {
    const std::clock_t start = std::clock();
    Row row;
    row.name = condition.name;
    row.is_balanced = condition.is_balanced;
    const int seeds = condition.seeds > 0 ? condition.seeds : effort.seeds;
    Judge judge(condition, row);
    try {
        while (row.seeds < seeds || judge.needs_another()) {
            ++row.seeds;
            BakeOptions options = condition.options;
            options.seed = static_cast<std::uint64_t>(row.seeds);
            options.iteration.iterations =
                condition.directions > 0 ? condition.directions : effort.directions;
            testing_support::Recorder told;
            judge.look_at(bake(condition.scene(options.seed), options, workers, told));
            for (const std::string& warning : told.warnings)
                if (warning.find("not repaired") != std::string::npos) judge.fault(warning);
        }
        judge.conclude();
    } catch (const std::exception& e) {
        judge.fault(e.what());
    }
    row.cpu_seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return row;
}

}  // namespace transillum::stability
