#include "first_shot/bound_direct_light.h"
#include "first_shot/light_vectors.h"

#include <transillum/base/sampling.h>
#include <transillum/first_shot/shoot_direct_light.h>
#include <transillum/visibility/hemicube.h>
#include <transillum/visibility/parallel_view.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>

namespace transillum {

namespace {

/// Pixels across the parallel projection of a directional light, to one along a hemicube's edge.
constexpr int parallel_resolution = 4, largest_parallel_resolution = 4096;

int across_parallel_view(int hemicube_resolution) {
    return std::min(parallel_resolution * hemicube_resolution, largest_parallel_resolution);
}

/// About the sample's normal, turned by a number that depends on the seed and the sample alone.
glm::dmat3 turned_frame(const LightSample& sample, Random& random) {
    const double turn = 2.0 * std::numbers::pi * random.next();
    const glm::dmat3 f = frame_about(sample.normal);
    const double c = std::cos(turn), s = std::sin(turn);
    return {c * f[0] + s * f[1], c * f[1] - s * f[0], f[2]};
}

class Shot {
public:
    Shot(const SurfaceMesh& mesh, const PatchHierarchy& patches, const Luminaires& luminaires,
         int resolution)
        : mesh_(mesh), patches_(patches), luminaires_(luminaires), resolution_(resolution) {
        light_.samples = luminaires.samples;
        light_.shot_sides = luminaires.shot_sides;
        light_.first_samples = luminaires.first_samples;
        light_.view_pixel = 2.0 / resolution;
        light_.parallel_pixel = pixel_size_for(mesh, across_parallel_view(resolution));
        if (light_.has_vectors()) {
            vectors_.emplace(mesh, patches, light_);
            return;
        }
        light_.geometry_factor.resize(light_.samples.size() * patches.patch_count());
        light_.visibility.resize(light_.geometry_factor.size());
    }

    /// A hemicube a sample, on each worker.
    void shoot_near(const Workers& workers, Monitor& monitor) {
        if (vectors_) return sum_up_near(workers, monitor);
        std::vector<std::unique_ptr<Hemicube>> hemicubes(workers.count());
        std::mutex reporting;
        const auto shoot = [&](std::size_t begin, std::size_t end, int worker) {
            auto& hemicube = hemicubes[worker];
            if (!hemicube) hemicube = std::make_unique<Hemicube>(mesh_, patches_, resolution_);
            for (std::size_t i = begin; i < end && !monitor.stop_requested(); ++i) {
                if (is_directional(i)) continue;
                keep(i, look(*hemicube, i));
                const std::lock_guard lock(reporting);
                report(monitor);
            }
        };
        workers.for_ranges(light_.samples.size(), 1, shoot);
    }

    /// All workers on a projection.
    void shoot_parallel(const Workers& workers, Monitor& monitor) {
        std::unique_ptr<ParallelView> view;
        for (std::size_t i = 0; i < light_.samples.size() && !monitor.stop_requested(); ++i) {
            if (!is_directional(i)) continue;
            if (!view)
                view = std::make_unique<ParallelView>(mesh_, patches_,
                                                      across_parallel_view(resolution_));
            Random random(luminaires_.seed, i);
            Bundle bundle{turned_frame(light_.samples[i], random)};
            bundle.offset_x = random.next();
            bundle.offset_y = random.next();
            const std::vector<PatchView>& views = view->look(bundle, workers);
            if (vectors_)
                vectors_->add(i, views, 1.0, workers);
            else
                keep(i, views);
            report(monitor);
        }
    }

    [[nodiscard]] DirectLight take() { return std::move(light_); }

private:
    [[nodiscard]] bool is_area(std::size_t i) const {
        return light_.samples[i].kind == LightSample::Kind::area;
    }
    [[nodiscard]] bool is_directional(std::size_t i) const {
        return light_.samples[i].kind == LightSample::Kind::directional;
    }
    [[nodiscard]] double scale(std::size_t i) const {
        return is_area(i) ? light_.samples[i].area : 1.0;
    }

    /// As many samples at a time as there are workers, summed up in their order.
    void sum_up_near(const Workers& workers, Monitor& monitor) {
        std::vector<std::unique_ptr<Hemicube>> hemicubes(workers.count());
        std::vector<const std::vector<PatchView>*> views(hemicubes.size());
        std::vector<std::size_t> near;
        for (std::size_t i = 0; i < light_.samples.size(); ++i)
            if (!is_directional(i)) near.push_back(i);
        for (std::size_t first = 0; first < near.size() && !monitor.stop_requested();
             first += views.size()) {
            const std::size_t count = std::min(views.size(), near.size() - first);
            workers.for_ranges(count, 1, [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t k = begin; k < end; ++k) {
                    auto& hemicube = hemicubes[k];
                    if (!hemicube)
                        hemicube = std::make_unique<Hemicube>(mesh_, patches_, resolution_);
                    views[k] = &look(*hemicube, near[first + k]);
                }
            });
            for (std::size_t k = 0; k < count; ++k) {
                const std::size_t i = near[first + k];
                vectors_->add(i, *views[k], scale(i), workers);
                report(monitor);
            }
        }
        vectors_->close(workers);
    }

    const std::vector<PatchView>& look(Hemicube& hemicube, std::size_t i) const {
        const LightSample& sample = light_.samples[i];
        Random random(luminaires_.seed, i);
        const glm::dmat3 frame = turned_frame(sample, random);
        if (is_area(i)) return hemicube.look(sample.position, frame);
        const PunctualLight& light = luminaires_.lights[sample.light];
        return hemicube.look_around(sample.position, frame, [&](const glm::dvec3& direction) {
            return light.distribution(direction);
        });
    }

    void keep(std::size_t i, const std::vector<PatchView>& views) {
        const std::size_t n = light_.samples.size();
        for (std::uint32_t p = 0; p < views.size(); ++p) {
            light_.geometry_factor[p * n + i] = static_cast<float>(views[p].mean_kernel * scale(i));
            light_.visibility[p * n + i] = views[p].visibility;
        }
    }

    void report(Monitor& monitor) {
        monitor.progress({"first shot", ++done_, light_.samples.size()});
    }

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    const Luminaires& luminaires_;
    int resolution_;
    DirectLight light_;
    std::optional<LightVectorSums> vectors_;  ///< where they are asked for
    std::uint64_t done_ = 0;
};

}  // namespace

DirectLight shoot_direct_light(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                               const Luminaires& luminaires, int hemicube_resolution,
                               const Workers& workers, Monitor& monitor) {
    Shot shot(mesh, patches, luminaires, hemicube_resolution);
    shot.shoot_near(workers, monitor);
    shot.shoot_parallel(workers, monitor);
    DirectLight light = shot.take();
    bound_direct_light(mesh, patches, light, workers);
    return light;
}

std::vector<Spectrum> direct_irradiance(const DirectLight& light, std::uint32_t patch_count) {
    std::vector<Spectrum> irradiance(patch_count, Spectrum(0.0f));
    for (std::uint32_t p = 0; p < patch_count; ++p) {
        SpectrumSum sum(0.0);
        for (std::size_t i = 0; i < light.columns(); ++i)
            sum += SpectrumSum(light.light(i).emitted) * light.share(p, i);
        irradiance[p] = Spectrum(sum);
    }
    return irradiance;
}

}  // namespace transillum
