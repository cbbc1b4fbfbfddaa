#include <transillum/base/sampling.h>
#include <transillum/first_shot/shoot_direct_light.h>
#include <transillum/visibility/hemicube.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

namespace transillum {

namespace {

/// About the sample's normal, turned by a number that depends on the sample alone.
glm::dmat3 turned_frame(const LightSample& sample, std::size_t index) {
    const double turn = 2.0 * std::numbers::pi * Random(index, 0).next();
    const glm::dmat3 f = frame_about(sample.normal);
    const double c = std::cos(turn), s = std::sin(turn);
    return {c * f[0] + s * f[1], c * f[1] - s * f[0], f[2]};
}

}  // namespace

DirectLight shoot_direct_light(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                               const Luminaires& luminaires, int hemicube_resolution,
                               const Workers& workers, Monitor& monitor) {
    DirectLight light;
    light.samples = luminaires.samples;
    light.shot_sides = luminaires.shot_sides;
    const std::size_t n = light.samples.size();
    light.projected_solid_angle.resize(n * patches.patch_count());
    light.visibility.resize(n * patches.patch_count());
    std::vector<std::unique_ptr<Hemicube>> hemicubes(workers.count());
    std::mutex reporting;
    std::uint64_t done = 0;
    workers.for_ranges(n, 1, [&](std::size_t begin, std::size_t end, int worker) {
        auto& hemicube = hemicubes[worker];
        if (!hemicube) hemicube = std::make_unique<Hemicube>(mesh, patches, hemicube_resolution);
        for (std::size_t i = begin; i < end && !monitor.stop_requested(); ++i) {
            const LightSample& sample = light.samples[i];
            const auto& views = hemicube->look(sample.position, turned_frame(sample, i));
            for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
                light.projected_solid_angle[p * n + i] =
                    static_cast<float>(views[p].mean_kernel * sample.area);
                light.visibility[p * n + i] = views[p].visibility;
            }
            const std::lock_guard lock(reporting);
            monitor.progress({"first shot", ++done, n});
        }
    });
    return light;
}

std::vector<Spectrum> direct_irradiance(const DirectLight& light, std::uint32_t patch_count) {
    const std::size_t n = light.samples.size();
    std::vector<Spectrum> irradiance(patch_count, Spectrum(0.0f));
    for (std::uint32_t p = 0; p < patch_count; ++p) {
        SpectrumSum sum(0.0);
        for (std::size_t i = 0; i < n; ++i)
            sum += SpectrumSum(light.samples[i].radiance) *
                   (double{light.visibility[p * n + i]} * light.projected_solid_angle[p * n + i]);
        irradiance[p] = Spectrum(sum);
    }
    return irradiance;
}

}  // namespace transillum
