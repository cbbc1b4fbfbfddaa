#include <transillum/scene/split_sun.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>

namespace transillum {

namespace {

constexpr double pi = std::numbers::pi;

/// The image while suns are taken out of it.
class SunFinder {
public:
    SunFinder(const Environment& environment, const SunOptions& options)
        : environment_(environment), options_(options), image_(*environment.image) {
        for (int row = 0; row < image_.height; ++row)
            solid_angles_.push_back(texel_solid_angle(image_, row));
        for (std::uint32_t t = 0; t < image_.texels.size(); ++t)
            whole_ += solid_angle(t) * brightness(t);
    }

    Suns find() {
        double threshold = options_.brightness * whole_ / (4.0 * pi);
        std::vector<std::uint32_t> bright(image_.texels.size());
        for (std::uint32_t t = 0; t < bright.size(); ++t) bright[t] = t;
        visited_at_.assign(bright.size(), 0.0);
        for (; threshold > 0.0; threshold *= 2.0) {
            std::erase_if(bright, [&](std::uint32_t t) { return !(brightness(t) > threshold); });
            if (bright.empty()) break;
            for (const std::uint32_t t : bright) try_region(t, threshold);
        }
        return std::move(suns_);
    }

    [[nodiscard]] Texture& image() { return image_; }

private:
    [[nodiscard]] int row_of(std::uint32_t t) const { return static_cast<int>(t) / image_.width; }
    [[nodiscard]] double brightness(std::uint32_t t) const {
        return mean_channel(SpectrumSum(image_.texels[t]));
    }
    [[nodiscard]] double solid_angle(std::uint32_t t) const { return solid_angles_[row_of(t)]; }

    [[nodiscard]] glm::dvec3 direction_of(std::uint32_t t) const {
        const int column = static_cast<int>(t) % image_.width;
        const double azimuth = environment_.rotation + 2.0 * pi * (column + 0.5) / image_.width;
        const double elevation = pi * (0.5 - (row_of(t) + 0.5) / image_.height);
        return sky_direction(environment_.up, azimuth, elevation);
    }

    /// The bright texels that hang together with this one; each is found once a threshold.
    std::vector<std::uint32_t> region_of(std::uint32_t first, double threshold) {
        std::vector<std::uint32_t> region;
        const auto visit = [&](std::uint32_t t) {
            if (visited_at_[t] == threshold || !(brightness(t) > threshold)) return;
            visited_at_[t] = threshold;
            region.push_back(t);
        };
        visit(first);
        for (std::size_t i = 0; i < region.size(); ++i) {
            const int column = static_cast<int>(region[i]) % image_.width, row = row_of(region[i]);
            for (int y = std::max(row - 1, 0); y <= std::min(row + 1, image_.height - 1); ++y)
                for (int dx = -1; dx <= 1; ++dx)
                    visit(static_cast<std::uint32_t>(y * image_.width +
                                                     (column + dx + image_.width) % image_.width));
        }
        return region;
    }

    void try_region(std::uint32_t first, double threshold) {
        const std::vector<std::uint32_t> region = region_of(first, threshold);
        double extent = 0.0, excess = 0.0;
        for (const std::uint32_t t : region) {
            extent += solid_angle(t);
            excess += solid_angle(t) * (brightness(t) - threshold);
        }
        if (region.empty() || extent > options_.most_solid_angle ||
            excess < options_.least_share * whole_)
            return;
        take(region, threshold);
        suns_.share += excess / whole_;
    }

    void take(const std::vector<std::uint32_t>& region, double threshold) {
        // One a channel: the vector irradiance, whose product with a normal is the irradiance.
        glm::dvec3 towards[channel_count] = {};
        for (const std::uint32_t t : region) {
            const SpectrumSum before =
                SpectrumSum(environment_.radiance_scale) * SpectrumSum(image_.texels[t]);
            const double kept = threshold / brightness(t);
            for (int c = 0; c < channel_count; ++c)
                towards[c] += solid_angle(t) * (1.0 - kept) * before[c] * direction_of(t);
            image_.texels[t] *= static_cast<float>(kept);
        }
        const glm::dvec3 sum = towards[0] + towards[1] + towards[2];
        if (!(glm::length(sum) > 0.0)) return;
        const glm::dvec3 direction = glm::normalize(sum);
        PunctualLight sun;
        sun.name = "sun " + std::to_string(suns_.lights.size() + 1);
        sun.kind = PunctualLight::Kind::directional;
        sun.direction = -direction;
        for (int c = 0; c < channel_count; ++c)
            sun.intensity[c] = static_cast<float>(std::max(0.0, glm::dot(towards[c], direction)));
        suns_.moved += SpectrumSum(sun.intensity);
        suns_.lights.push_back(sun);
    }

    const Environment& environment_;
    const SunOptions& options_;
    Texture image_;
    std::vector<double> solid_angles_;  ///< by row
    double whole_ = 0.0;
    std::vector<double> visited_at_;  ///< threshold, a texel
    Suns suns_;
};

}  // namespace

Suns split_sun(Environment& environment, const SunOptions& options) {
    if (environment.kind != Environment::Kind::image || !environment.image) return {};
    SunFinder finder(environment, options);
    Suns suns = finder.find();
    if (!suns.lights.empty())
        environment.image = std::make_shared<const Texture>(std::move(finder.image()));
    return suns;
}

}  // namespace transillum
