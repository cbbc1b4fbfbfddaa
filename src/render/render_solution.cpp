#include "render/camera_rays.h"
#include "render/pixel_sampler.h"
#include "render/solution_shader.h"

#include <transillum/base/error.h>
#include <transillum/render/render_solution.h>

#include <algorithm>
#include <limits>
#include <string>

namespace transillum {

namespace {

constexpr int base_samples = 4;
constexpr int most_samples = 4096;
constexpr int rows_between_reports = 16;
/// Pixels whose surroundings vary by more, relative to their brightest channel, are sampled
/// further.
constexpr float contrast_threshold = 0.04f;

struct PixelRecord {
    SpectrumSum sum{0.0};
    Spectrum low{std::numeric_limits<float>::infinity()}, high{0.0f};
    int samples = 0, on_emitter = 0;
};

class Renderer {
public:
    Renderer(const Solution& solution, const Camera& camera, const RenderOptions& options,
             const Workers& workers, Monitor& monitor)
        : options_(options),
          workers_(workers),
          monitor_(monitor),
          view_(camera, options.width, options.height),
          shader_(solution, options, workers),
          records_(static_cast<std::size_t>(options.width) * options.height) {}

    Image render() {
        const int base = std::min(base_samples, options_.samples);
        for_rows([&](int y) {
            for (int x = 0; x < options_.width; ++x) sample_pixel(x, y, base);
        });
        if (options_.samples > base) {
            std::vector<char> rough(records_.size(), 0);
            for (int y = 0; y < options_.height; ++y)
                for (int x = 0; x < options_.width; ++x) rough[index(x, y)] = varies_around(x, y);
            for_rows([&](int y) {
                for (int x = 0; x < options_.width; ++x)
                    if (rough[index(x, y)]) sample_pixel(x, y, options_.samples);
            });
        }
        return mean_image();
    }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * options_.width + x;
    }

    template <class Row>
    void for_rows(Row row) {
        for (int first = 0; first < options_.height && !monitor_.stop_requested();
             first += rows_between_reports) {
            const int last = std::min(first + rows_between_reports, options_.height);
            workers_.for_ranges(static_cast<std::size_t>(last - first), 1,
                                [&](std::size_t from, std::size_t to, int) {
                                    for (std::size_t y = from; y < to; ++y)
                                        row(first + static_cast<int>(y));
                                });
            rows_done_ += static_cast<std::uint64_t>(last - first);
            monitor_.progress({"render", rows_done_, total_rows()});
        }
    }

    [[nodiscard]] std::uint64_t total_rows() const {
        return static_cast<std::uint64_t>(options_.height) *
               (options_.samples > base_samples ? 2 : 1);
    }

    /// Goes on until the pixel has so many samples; a power of two of them is stratified over its
    /// square.
    void sample_pixel(int x, int y, int samples) {
        PixelRecord& record = records_[index(x, y)];
        for (; record.samples < samples; ++record.samples) {
            PixelSampler random(options_.seed, index(x, y),
                                static_cast<std::uint32_t>(record.samples));
            const glm::dvec2 u(random.next_pair());
            const Sight sight = shader_.look({view_.eye(), view_.direction(x + u.x, y + u.y)});
            record.sum += SpectrumSum(sight.radiance);
            record.low = glm::min(record.low, sight.radiance);
            record.high = glm::max(record.high, sight.radiance);
            record.on_emitter += sight.emits;
        }
    }

    /// Neighbours count too: an edge often passes between a pixel's own samples and its border.
    [[nodiscard]] bool varies_around(int x, int y) const {
        Spectrum low(std::numeric_limits<float>::infinity()), high(0.0f);
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, options_.height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, options_.width - 1); ++u) {
                low = glm::min(low, records_[index(u, v)].low);
                high = glm::max(high, records_[index(u, v)].high);
            }
        return max_channel(high - low) > contrast_threshold * max_channel(high);
    }

    [[nodiscard]] Image mean_image() const {
        Image image{options_.width, options_.height, {}, {}};
        for (const PixelRecord& record : records_) {
            const double n = std::max(record.samples, 1);
            image.pixels.emplace_back(record.sum / n);
            image.emitter_mask.push_back(static_cast<float>(record.on_emitter / n));
        }
        return image;
    }

    RenderOptions options_;
    const Workers& workers_;
    Monitor& monitor_;
    CameraRays view_;
    SolutionShader shader_;
    std::vector<PixelRecord> records_;
    std::uint64_t rows_done_ = 0;
};

}  // namespace

Image render_solution(const Solution& solution, const Camera& camera, const RenderOptions& options,
                      const Workers& workers, Monitor& monitor) {
    if (options.samples < 1 || options.samples > most_samples)
        throw UsageError("samples: " + std::to_string(options.samples) + "; accepted: 1 to " +
                         std::to_string(most_samples));
    return Renderer(solution, camera, options, workers, monitor).render();
}

}  // namespace transillum
