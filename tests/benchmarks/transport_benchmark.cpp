// Throughput of the transport against rays, and its scaling with leaves and triangles. Compare
// within one run.
#include "benchmarks/scenes.h"
#include "support/random_hierarchy.h"

#include <transillum/base/sampling.h>
#include <transillum/transport/iterate.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <array>

namespace {

using namespace transillum;
using benchmarks::room_of_spheres;

constexpr int window = 1000;
constexpr int threads = 2;

/// Rooms with spheres in them: 0: one of 48 triangles; 1: eight, 52 k in all; 2: 64, 54 k; 3: 64,
/// 379 k.
const SurfaceMesh& scene_of(std::int64_t number) {
    static const std::array<SurfaceMesh, 4> scenes{room_of_spheres(1, 4), room_of_spheres(2, 41),
                                                   room_of_spheres(4, 15), room_of_spheres(4, 39)};
    return scenes.at(static_cast<std::size_t>(number));
}

/// Arguments: scene, level of every root, rounds after it in which a third of the leaves split.
void whole_iteration(benchmark::State& state) {
    const SurfaceMesh& mesh = scene_of(state.range(0));
    const PatchHierarchy patches = testing_support::random_hierarchy(
        std::vector<int>(mesh.triangles.size(), static_cast<int>(state.range(1))),
        static_cast<int>(state.range(2)), 1);
    const std::uint32_t n = patches.patch_count();
    PatchSources sources;
    sources.emission.assign(n, Spectrum(1.0f));
    sources.direct.assign(n, Spectrum(0.0f));
    sources.albedo.assign(n, Spectrum(0.5f));
    const Workers workers(threads);
    Monitor silent;
    IterationOptions options;
    options.iterations = 1024;
    options.pixel_size = pixel_size_for(mesh, window);
    std::uint64_t fragments = 0, directions = 0;
    for (auto _ : state) {
        const TransportResult result = iterate(mesh, patches, sources, options, workers, silent);
        fragments += result.fragments;
        directions += result.iterations;
    }
    state.counters["fragments/s"] =
        benchmark::Counter(static_cast<double>(fragments), benchmark::Counter::kIsRate);
    state.counters["s/direction"] = benchmark::Counter(
        static_cast<double>(directions), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
    state.counters["leaves"] = patches.leaf_count;
}

RTCScene embree_scene(RTCDevice device, const SurfaceMesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size()));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        for (int k = 0; k < 3; ++k) vertices[3 * i + k] = static_cast<float>(mesh.positions[i][k]);
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) indices[3 * i + k] = mesh.triangles[i].vertices[k];
    rtcCommitGeometry(geometry);
    RTCScene scene = rtcNewScene(device);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

/// Argument: scene. Rays from random points of the room in random directions, one at a time.
void incoherent_rays(benchmark::State& state) {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = embree_scene(device, scene_of(state.range(0)));
    const Workers workers(threads);
    constexpr std::size_t rays = 1 << 18;
    std::vector<RTCRay> prepared(rays);
    Random random(1, 2);
    for (RTCRay& ray : prepared) {
        const glm::dvec3 d = uniform_direction(random.next(), random.next());
        ray = {};
        ray.org_x = static_cast<float>(random.next());
        ray.org_y = static_cast<float>(random.next());
        ray.org_z = static_cast<float>(random.next());
        ray.dir_x = static_cast<float>(d.x);
        ray.dir_y = static_cast<float>(d.y);
        ray.dir_z = static_cast<float>(d.z);
        ray.tfar = std::numeric_limits<float>::infinity();
        ray.mask = ~0u;
    }
    for (auto _ : state) {
        workers.for_ranges(rays, 4096, [&](std::size_t begin, std::size_t end, int) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            for (std::size_t i = begin; i < end; ++i) {
                RTCRayHit ray{prepared[i], {}};
                ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                rtcIntersect1(scene, &context, &ray);
                benchmark::DoNotOptimize(ray.ray.tfar);
            }
        });
    }
    state.counters["rays/s"] = benchmark::Counter(static_cast<double>(rays * state.iterations()),
                                                  benchmark::Counter::kIsRate);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}

BENCHMARK(incoherent_rays)
    ->ArgName("scene")
    ->Arg(0)
    ->Arg(1)
    ->Arg(2)
    ->Arg(3)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(whole_iteration)
    ->ArgNames({"scene", "level", "splits"})
    ->Args({0, 4, 0})
    ->Args({0, 4, 1})
    ->Args({0, 5, 0})
    ->Args({0, 6, 0})
    ->Args({1, 0, 0})
    ->Args({2, 0, 0})
    ->Args({2, 0, 1})
    ->Args({2, 1, 0})
    ->Args({2, 2, 0})
    ->Args({3, 0, 0})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
