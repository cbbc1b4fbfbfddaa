#include "render/bundle_gather.h"
#include "render/camera_rays.h"
#include "render/pixel_sampler.h"
#include "render/solution_shader.h"

#include <transillum/base/error.h>
#include <transillum/render/render_solution.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

namespace transillum {

namespace {

constexpr int base_samples = 4;
constexpr int base_iterations = 16;  ///< from which noise is estimated
constexpr int most_samples = 4096;
/// Rows between reports: at least, and for each thread, which would idle at their end otherwise.
constexpr int least_rows = 16, rows_a_thread = 8;
/// Pixels whose surroundings vary by more, relative to their brightest channel, are sampled
/// further. What is left to chance has no say in that: noise is no edge.
constexpr float contrast_threshold = 0.04f;
/// Standard error of what is left to chance that is aimed at, relative to the surroundings.
constexpr double noise_threshold = 0.02;

/// All over the picture, whose top may take longer than the rest: what is done is a fair sample of
/// what is left.
std::vector<int> spread_rows(int height, int rows_between_reports) {
    const int count = (height + rows_between_reports - 1) / rows_between_reports;
    int step = std::max(1, static_cast<int>(std::lround((std::numbers::phi - 1.0) * count)));
    while (std::gcd(step, count) > 1) ++step;
    std::vector<int> first_rows;
    for (int i = 0; i < count; ++i)
        first_rows.push_back(static_cast<int>(std::int64_t{i} * step % count) *
                             rows_between_reports);
    return first_rows;
}

struct PixelRecord {
    Spectrum steady{0.0f}, by_chance{0.0f};
    float chance_squares = 0.0f;  ///< of its luminance
    Spectrum low{std::numeric_limits<float>::infinity()}, high{0.0f};
    int samples = 0, steady_samples = 0, iterations = 0, on_emitter = 0;
    bool has_chance = false;

    [[nodiscard]] SpectrumSum mean() const {
        return SpectrumSum(steady) / double(std::max(steady_samples, 1)) +
               SpectrumSum(by_chance) / double(std::max(iterations, 1));
    }
    /// Of one iteration.
    [[nodiscard]] double variance() const {
        if (iterations < 2) return 0.0;
        const double n = iterations, sum = luminance(by_chance);
        return std::max(0.0, (double{chance_squares} - sum * sum / n) / (n - 1.0));
    }
};

/// Samples a pixel in all.
struct Target {
    int samples = 0, iterations = 0;
};

class Rendering {
public:
    Rendering(const SolutionShader& shader, BundleGather* gather, const Camera& camera,
              const RenderOptions& options, const Workers& workers, Monitor& monitor)
        : options_(options),
          workers_(workers),
          monitor_(monitor),
          view_(camera, options.width, options.height),
          shader_(shader),
          gather_(gather),
          rows_between_reports_(std::max(least_rows, rows_a_thread * workers.count())),
          first_rows_(spread_rows(options.height, rows_between_reports_)),
          records_(static_cast<std::size_t>(options.width) * options.height) {}

    Image render() {
        const int base = std::min(base_samples, options_.samples);
        sample_all("render", [&](int, int) { return Target{base, base}; });
        const bool has_chance = std::ranges::any_of(records_, &PixelRecord::has_chance);
        if (options_.samples > base || (has_chance && options_.iterations > base))
            sample_where_needed("render: edges", [&](int x, int y) {
                return Target{
                    options_.samples > base && varies_around(x, y) ? options_.samples : base,
                    has_chance_around(x, y) ? base_iterations : 0};
            });
        if (has_chance && options_.iterations > base_iterations)
            sample_where_needed("render: noise", [&](int x, int y) {
                return Target{0, iterations_for(x, y)};
            });
        if (gather_)
            gathered_ = gather_->gather({view_, options_.width, options_.height, options_.seed},
                                        options_.iterations, monitor_);
        return mean_image();
    }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * options_.width + x;
    }

    template <class Pixel>
    void for_pixels(Pixel pixel, const char* phase = nullptr) {
        int done = 0;
        for (const int first : first_rows_) {
            if (monitor_.stop_requested()) return;
            const int last = std::min(first + rows_between_reports_, options_.height);
            workers_.for_ranges(static_cast<std::size_t>(last - first), 1,
                                [&](std::size_t from, std::size_t to, int) {
                                    for (std::size_t y = from; y < to; ++y)
                                        for (int x = 0; x < options_.width; ++x)
                                            pixel(x, first + static_cast<int>(y));
                                });
            done += last - first;
            if (phase)
                monitor_.progress({phase, static_cast<std::uint64_t>(done),
                                   static_cast<std::uint64_t>(options_.height)});
        }
    }

    template <class TargetOf>
    void sample_all(const char* phase, TargetOf target_of) {
        for_pixels([&](int x, int y) { sample_pixel(x, y, target_of(x, y)); }, phase);
    }

    /// The targets follow from the samples there are, those of neighbours among them.
    template <class TargetOf>
    void sample_where_needed(const char* phase, TargetOf target_of) {
        targets_.assign(records_.size(), {});
        for_pixels([&](int x, int y) { targets_[index(x, y)] = target_of(x, y); });
        const bool needed = std::ranges::any_of(records_, [&](const PixelRecord& r) {
            const Target& t = targets_[static_cast<std::size_t>(&r - records_.data())];
            return std::max(t.samples, std::min(t.iterations, options_.iterations)) > r.samples;
        });
        if (needed) sample_all(phase, [&](int x, int y) { return targets_[index(x, y)]; });
    }

    /// Goes on until the pixel has so many samples; a power of two of them is stratified over its
    /// square.
    void sample_pixel(int x, int y, Target target) {
        PixelRecord& record = records_[index(x, y)];
        const int iterations = std::min(target.iterations, options_.iterations);
        while (record.samples < std::max(target.samples, iterations)) {
            const Wanted wanted{record.samples < target.samples, record.samples < iterations};
            PixelSampler random(options_.seed, index(x, y),
                                static_cast<std::uint32_t>(record.samples));
            const glm::dvec2 u(random.next_pair());
            const Ray ray{view_.eye(), view_.direction(x + u.x, y + u.y)};
            add(record, shader_.look(ray, wanted, random), wanted);
        }
    }

    static void add(PixelRecord& record, const Sight& sight, Wanted wanted) {
        ++record.samples;
        record.on_emitter += sight.emits;
        record.has_chance = record.has_chance || sight.has_chance;
        if (wanted.steady) {
            ++record.steady_samples;
            record.steady += sight.steady;
            record.low = glm::min(record.low, sight.steady);
            record.high = glm::max(record.high, sight.steady);
        }
        if (wanted.by_chance) {
            ++record.iterations;
            record.by_chance += sight.by_chance;
            const float l = luminance(sight.by_chance);
            record.chance_squares += l * l;
        }
    }

    /// Neighbours count too: an edge often passes between a pixel's own samples and its border.
    template <class Body>
    void for_neighbours(int x, int y, Body body) const {
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, options_.height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, options_.width - 1); ++u)
                body(records_[index(u, v)]);
    }

    [[nodiscard]] bool varies_around(int x, int y) const {
        Spectrum low(std::numeric_limits<float>::infinity()), high(0.0f);
        for_neighbours(x, y, [&](const PixelRecord& r) {
            low = glm::min(low, r.low);
            high = glm::max(high, r.high);
        });
        return max_channel(high - low) > contrast_threshold * max_channel(high);
    }

    [[nodiscard]] bool has_chance_around(int x, int y) const {
        bool any = false;
        for_neighbours(x, y, [&](const PixelRecord& r) { any = any || r.has_chance; });
        return any;
    }

    /// From the variance of a neighbourhood: a pixel's own few iterations may have missed what
    /// varies.
    [[nodiscard]] int iterations_for(int x, int y) const {
        double variance = 0.0, mean = 0.0, count = 0.0;
        for_neighbours(x, y, [&](const PixelRecord& r) {
            variance += r.variance();
            mean += luminance(r.mean());
            count += 1.0;
        });
        const double aimed_at = noise_threshold * mean / count;
        if (!(variance > 0.0) || !(aimed_at > 0.0)) return 0;
        const double needed = variance / count / (aimed_at * aimed_at);
        if (needed >= options_.iterations) return options_.iterations;
        return static_cast<int>(std::bit_ceil(static_cast<unsigned>(needed)));
    }

    [[nodiscard]] Image mean_image() const {
        Image image{options_.width, options_.height, {}, {}};
        image.pixels.reserve(records_.size());
        image.emitter_mask.reserve(records_.size());
        for (const PixelRecord& record : records_) {
            SpectrumSum sum = record.mean();
            if (!gathered_.empty()) sum += SpectrumSum(gathered_[image.pixels.size()]);
            // The Monte-Carlo component may be below 0 where the rest is dark.
            image.pixels.emplace_back(glm::max(sum, SpectrumSum(0.0)));
            image.emitter_mask.push_back(static_cast<float>(record.on_emitter) /
                                         static_cast<float>(std::max(record.samples, 1)));
        }
        return image;
    }

    const RenderOptions& options_;
    const Workers& workers_;
    Monitor& monitor_;
    CameraRays view_;
    const SolutionShader& shader_;
    BundleGather* gather_;
    std::vector<Spectrum> gathered_;  ///< of the pixels; empty without bundles
    const int rows_between_reports_;
    const std::vector<int> first_rows_;  ///< between reports, in the order that they are worked on
    std::vector<PixelRecord> records_;
    std::vector<Target> targets_;
};

void check_count(const char* name, int count) {
    if (count < 1 || count > most_samples)
        throw UsageError(fmt::format("{}: {}; accepted: 1 to {}", name, count, most_samples));
}

bool has_sharp_lobes(const Solution& s) {
    return std::ranges::any_of(s.glossy.sides, [&](const GlossySide& side) {
        return is_sharper_than_bins(s.glossy.brdfs[side.brdf]);
    });
}

RenderOptions decided(const Solution& s, RenderOptions options, Monitor& monitor) {
    using enum MonteCarloShading;
    check_count("samples", options.samples);
    check_count("iterations", options.iterations);
    MonteCarloShading& how = options.monte_carlo;
    if (!options.components.monte_carlo) how = off;
    if (how == automatic) {
        how = s.glossy.empty() ? off : rays;
        monitor.note(how == rays ? fmt::format("Monte-Carlo component, up to {} rays a pixel: "
                                               "{} sides have glossy lobes",
                                               options.iterations, s.glossy.sides.size())
                                 : "no Monte-Carlo component: no surface has a glossy lobe");
    }
    if (has_sharp_lobes(s))
        monitor.note("rays follow reflections: some lobes are sharper than any direction bin");
    return options;
}

std::unique_ptr<BundleGather> make_gather(const Solution& solution, const SolutionShader& shader,
                                          const RenderOptions& options, const Workers& workers) {
    switch (options.monte_carlo) {
        case MonteCarloShading::subpatch:
            return make_subpatch_gather(solution, shader, options.seed, workers);
        case MonteCarloShading::wavefront:
            return make_wavefront_gather(solution, shader, options.seed, workers);
        default:
            return nullptr;
    }
}

}  // namespace

SolutionRenderer::SolutionRenderer(const Solution& solution, const RenderOptions& options,
                                   const Workers& workers, Monitor& monitor)
    : options_(decided(solution, options, monitor)),
      shader_(std::make_unique<SolutionShader>(solution, options_, workers)),
      gather_(make_gather(solution, *shader_, options_, workers)) {
    if (options_.components.direct && options_.direct == DirectShading::traced &&
        solution.direct.columns() > 0 && !solution.direct.has_vectors())
        monitor.note(
            fmt::format("shadow rays to {:.1f} % of the light samples that patches face: "
                        "the others are seen wholly there, and all around",
                        100.0 * shader_->direct().doubtful_share()));
}

SolutionRenderer::~SolutionRenderer() = default;
SolutionRenderer::SolutionRenderer(SolutionRenderer&&) noexcept = default;
SolutionRenderer& SolutionRenderer::operator=(SolutionRenderer&&) noexcept = default;

void SolutionRenderer::set_picture(int width, int height, std::uint64_t seed) {
    if (std::min(width, height) < 1)
        throw UsageError(
            fmt::format("a picture of {} x {} pixels; accepted: at least 1 x 1", width, height));
    options_.width = width;
    options_.height = height;
    options_.seed = seed;
}

Image SolutionRenderer::render(const Camera& camera, const Workers& workers, Monitor& monitor) {
    return Rendering(*shader_, gather_.get(), camera, options_, workers, monitor).render();
}

Image render_solution(const Solution& solution, const Camera& camera, const RenderOptions& options,
                      const Workers& workers, Monitor& monitor) {
    return SolutionRenderer(solution, options, workers, monitor).render(camera, workers, monitor);
}

}  // namespace transillum
