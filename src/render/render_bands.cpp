#include <transillum/base/part_monitor.h>
#include <transillum/render/render_bands.h>

#include <fmt/format.h>

#include <utility>

namespace transillum {

namespace {

/// \param image_of gives the image of a group.
template <class ImageOf>
Image mix_groups(const Bands& bands, Monitor& monitor, ImageOf image_of) {
    Image mixed;
    std::vector<SpectrumSum> sums;
    for (int g = 0; g < bands.groups(); ++g) {
        PartMonitor part(monitor, fmt::format("bands, group {} of {}", g + 1, bands.groups()));
        const Image image = image_of(g, part);
        sums.resize(image.pixels.size(), SpectrumSum(0.0));
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += bands.rgb_from_group(g) * SpectrumSum(image.pixels[i]);
        mixed.width = image.width;
        mixed.height = image.height;
        // An emitter is one in every group where it shines at all.
        mixed.emitter_mask.resize(image.emitter_mask.size(), 0.0f);
        for (std::size_t i = 0; i < mixed.emitter_mask.size(); ++i)
            mixed.emitter_mask[i] = std::max(mixed.emitter_mask[i], image.emitter_mask[i]);
    }
    mixed.pixels.assign(sums.begin(), sums.end());
    return mixed;
}

}  // namespace

BandRenderer::BandRenderer(SpectralSolution spectral, const RenderOptions& options,
                           const Workers& workers, Monitor& monitor)
    : bands_(spectral.bands) {
    Monitor silent;
    const int groups = static_cast<int>(spectral.groups.size());
    for (int g = 0; g < std::max(groups, 1); ++g) {
        solutions_.push_back(groups == 0 ? std::move(spectral.rgb)
                                         : solution_of_group(spectral, g));
        renderers_.emplace_back(solutions_.back(), options, workers, g == 0 ? monitor : silent);
    }
}

Image BandRenderer::render(const Camera& camera, const Workers& workers, Monitor& monitor) {
    if (bands_ == 0) return renderers_.front().render(camera, workers, monitor);
    return mix_groups(Bands(bands_), monitor, [&](int g, Monitor& part) {
        return renderers_[static_cast<std::size_t>(g)].render(camera, workers, part);
    });
}

Image render_bands(const SpectralSolution& spectral, const Camera& camera,
                   const RenderOptions& options, const Workers& workers, Monitor& monitor) {
    if (spectral.groups.empty())
        return render_solution(spectral.rgb, camera, options, workers, monitor);
    const Bands bands(spectral.bands);
    Solution solution = spectral.rgb;
    return mix_groups(bands, monitor, [&](int g, Monitor& part) {
        put_into_group(solution, spectral, bands, g);
        return g == 0 ? SolutionRenderer(solution, options, workers, monitor)
                            .render(camera, workers, part)
                      : render_solution(solution, camera, options, workers, part);
    });
}

Image path_trace_bands(SurfaceMesh surface, const Scene& scene, const SpectralOptions& spectral,
                       const Camera& camera, const PathTraceOptions& options,
                       const Workers& workers, Monitor& monitor) {
    const Bands bands(spectral.bands);
    const Colours of_scene{scene.materials, scene.textures, scene.lighting};
    return mix_groups(bands, monitor, [&](int g, Monitor& part) {
        Colours colours = measured_colours_in_group(of_scene, spectral, bands, g, part);
        surface.materials = std::move(colours.materials);
        surface.textures = std::move(colours.textures);
        return path_trace(surface, colours.lighting, camera, options, workers, part);
    });
}

}  // namespace transillum
