// The image of a path tracer. Paths are shared within a tile: what one of them finds the diffuse
// part of its second surface to reflect is gathered by every first surface of the tile that sees it
// (Bekaert, Sbert and Halton 2002, "Accelerating path tracing by re-using paths"); the balance
// heuristic keeps every pixel unbiased. What the second surface's lobe reflects depends on where it
// goes, and stays with the path that found it.
#include "render/camera_rays.h"
#include "render/path_tracer.h"

#include <transillum/base/error.h>
#include <transillum/render/path_trace.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace transillum {

namespace {

/// Measured in a Cornell box: the same noise takes a seventh of the time of unshared paths.
constexpr int largest_tile = 8;

struct PixelSum {
    SpectrumSum radiance{0.0};
    int on_emitter = 0;
};

struct PixelPath {
    std::size_t pixel = 0;
    EyePath path;
};

/// One path a pixel.
struct Tile {
    std::array<PixelPath, largest_tile * largest_tile> paths;
    int count = 0;
};

/// The second surface of a path, seen from a first one.
struct Sight {
    double density = 0.0;   ///< per area, with which that path finds the point; 0 where unseen
    Spectrum weight{0.0f};  ///< of the point's light, with its coupling, before the density
};

Sight sight(const PathVertex& first, const PathVertex& second) {
    const glm::dvec3 way = second.point - first.point;
    const double distance2 = glm::dot(way, way);
    const glm::dvec3 direction = way / std::sqrt(distance2);
    const double cosine = -glm::dot(second.normal, direction);
    if (!(cosine > 0.0 && glm::dot(first.normal, direction) > 0.0)) return {};
    const glm::vec3 in = first.local(direction);
    const double per_area = cosine / distance2;
    const double density = direction_density(first.brdf, in, first.out) * per_area;
    if (!(density > 0.0)) return {};
    const float coupling = diffuse_coupling(second.brdf, static_cast<float>(cosine));
    return {density,
            evaluate(first.brdf, in, first.out) * (in.z * coupling * static_cast<float>(per_area))};
}

/// Adds what every first surface reflects of the light from the second surface of `paths[source]`:
/// over the sum of the densities with which the tile's paths find that point.
void share_second_surface(const PathTracer& tracer, const Tile& tile, int source,
                          std::vector<PixelSum>& sums) {
    const EyePath& from = tile.paths[source].path;
    if (!(max_channel(from.from_second) > 0.0f)) return;
    std::array<Sight, largest_tile * largest_tile> sights{};
    double total = 0.0;
    for (int i = 0; i < tile.count; ++i) {
        const EyePath& to = tile.paths[i].path;
        if (!to.reflects) continue;
        sights[i] = sight(to.first, from.second);
        if (i != source && sights[i].density > 0.0 && !tracer.sees(to.first, from.second))
            sights[i] = {};
        total += sights[i].density;
    }
    if (!(total > 0.0)) return;
    for (int i = 0; i < tile.count; ++i)
        sums[tile.paths[i].pixel].radiance +=
            SpectrumSum(from.from_second * sights[i].weight) / total;
}

/// The tiles of one pass. They are moved from pass to pass, so that their outlines do not show.
struct Tiling {
    Tiling(const PathTraceOptions& options, int pass)
        : width(options.width),
          height(options.height),
          tile_size(options.shares_paths ? largest_tile : 1),
          left(-static_cast<int>(hash_bits(options.seed ^ hash_bits(2 * pass)) % tile_size)),
          top(-static_cast<int>(hash_bits(options.seed ^ hash_bits(2 * pass + 1)) % tile_size)),
          columns((width - left + tile_size - 1) / tile_size),
          rows((height - top + tile_size - 1) / tile_size) {}

    template <class Visit>
    void for_pixels(std::size_t tile, Visit visit) const {
        const int x0 = left + static_cast<int>(tile % columns) * tile_size;
        const int y0 = top + static_cast<int>(tile / columns) * tile_size;
        for (int y = std::max(y0, 0); y < std::min(y0 + tile_size, height); ++y)
            for (int x = std::max(x0, 0); x < std::min(x0 + tile_size, width); ++x) visit(x, y);
    }

    int width, height, tile_size, left, top, columns, rows;
};

void trace_tile(const PathTracer& tracer, const CameraRays& view, const Tiling& tiling,
                std::size_t number, std::uint64_t seed, int sample, std::vector<PixelSum>& sums) {
    Tile tile;
    tiling.for_pixels(number, [&](int x, int y) {
        const std::size_t pixel = static_cast<std::size_t>(y) * tiling.width + x;
        PixelSampler random(seed, pixel, static_cast<std::uint32_t>(sample));
        const glm::vec2 u = random.next_pair();
        PixelPath& p = tile.paths[tile.count++];
        p = {pixel,
             tracer.start({view.eye(), view.direction(x + double(u.x), y + double(u.y))}, random)};
        sums[pixel].radiance += SpectrumSum(p.path.emitted + p.path.direct + p.path.from_lobe);
        sums[pixel].on_emitter += max_channel(p.path.emitted) > 0.0f;
    });
    for (int i = 0; i < tile.count; ++i) share_second_surface(tracer, tile, i, sums);
}

void check_options(const PathTraceOptions& options) {
    if (options.samples < 1)
        throw UsageError("samples: " + std::to_string(options.samples) + "; accepted: 1 or more");
    if (options.max_bounces < 0)
        throw UsageError("bounces: " + std::to_string(options.max_bounces) +
                         "; accepted: 0 (no limit) or more");
}

Image mean_image(const std::vector<PixelSum>& sums, int samples, int width, int height) {
    Image image{width, height, {}, {}};
    for (const PixelSum& sum : sums) {
        image.pixels.emplace_back(sum.radiance / static_cast<double>(samples));
        image.emitter_mask.push_back(static_cast<float>(sum.on_emitter) /
                                     static_cast<float>(samples));
    }
    return image;
}

}  // namespace

Image path_trace(const SurfaceMesh& surface, const Lighting& lighting, const Camera& camera,
                 const PathTraceOptions& options, const Workers& workers, Monitor& monitor) {
    check_options(options);
    const CameraRays view(camera, options.width, options.height);
    const PathTracer tracer(surface, lighting, options.max_bounces);
    std::vector<PixelSum> sums(static_cast<std::size_t>(options.width) * options.height);
    if (tracer.dark()) return mean_image(sums, 1, options.width, options.height);

    int done = 0;
    while (done < options.samples && !(done > 0 && monitor.stop_requested())) {
        const Tiling tiling(options, done);
        const std::size_t tiles = static_cast<std::size_t>(tiling.columns) * tiling.rows;
        workers.for_ranges(tiles, 16, [&](std::size_t from, std::size_t to, int) {
            for (std::size_t tile = from; tile < to; ++tile)
                trace_tile(tracer, view, tiling, tile, options.seed, done, sums);
        });
        ++done;
        monitor.progress({"path tracing", static_cast<std::uint64_t>(done),
                          static_cast<std::uint64_t>(options.samples)});
    }
    return mean_image(sums, done, options.width, options.height);
}

Spectrum path_trace_irradiance(const SurfaceMesh& surface, const Lighting& lighting,
                               const glm::dvec3& point, const glm::dvec3& normal, int paths,
                               std::uint64_t seed) {
    if (paths < 1) throw UsageError("paths: " + std::to_string(paths) + "; accepted: 1 or more");
    const PathTracer tracer(surface, lighting, 0);
    if (tracer.dark()) return Spectrum(0.0f);
    SpectrumSum sum(0.0);
    // A white Lambert surface reflects irradiance / pi.
    const PathVertex white(point, normal, {.diffuse = Spectrum(1.0f)}, normal);
    for (int i = 0; i < paths; ++i) {
        PixelSampler random(seed, 0, static_cast<std::uint32_t>(i));
        sum += SpectrumSum(tracer.reflected(white, 0, random).diffuse);
    }
    return Spectrum(sum * (std::numbers::pi / paths));
}

}  // namespace transillum
