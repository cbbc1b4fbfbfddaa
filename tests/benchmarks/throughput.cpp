// What the transport makes of its time, and what rays would.
//
//   bench_throughput [--rounds N] [--directions N] [--threads N] [SCENE...] > throughput.csv
//
// Without SCENE: closed rooms with spheres in them, of 48 to 1.4 million triangles. Every round
// goes through all scenes; figures are medians over the rounds. A triangle is a leaf, windows are
// 1000 pixels wide. A fragment is a surface point behind a pixel: it exchanges light both ways.
//
//   fragments_per_s       exchanged in the whole iteration
//   cycles_per_fragment   of a core: threads * clock / fragments_per_s
//   ns_*                  of a thread, a fragment: the stages; `accumulate` is all beside them:
//                         what patches send and have received, the balance, and waiting
//   incoherent_per_s      rays that rtcIntersect1 traces from random points of the surfaces, each
//                         into a random direction about the normal, as a path tracer does
//   coherent_per_s        the same through neighbouring pixels of a parallel window
//   ratio_*               fragments_per_s over these
#include "benchmarks/scenes.h"

#include <transillum/base/sampling.h>
#include <transillum/scene/load_scene.h>
#include <transillum/transport/iterate.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace {

using namespace transillum;
using benchmarks::room_of_spheres;

constexpr int window = 1000;
constexpr std::size_t ray_count = std::size_t{1} << 18;

double seconds_of(const auto& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of a core at work: additions that wait for each other take one cycle each.
double clock_hertz() {
    constexpr std::uint64_t additions = 200'000'000;
    std::uint64_t x = 1;
    const double seconds = seconds_of([&] {
        for (std::uint64_t i = 0; i < additions; i += 10)
            for (int k = 0; k < 10; ++k) {
                x += i;
                asm volatile("" : "+r"(x));
            }
    });
    return static_cast<double>(additions) / seconds;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

RTCRay make_ray(const glm::dvec3& origin, const glm::dvec3& direction) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = ~0u;
    return ray;
}

/// From points spread evenly over the surfaces, cosine-distributed.
std::vector<RTCRay> incoherent_rays(const SurfaceMesh& mesh) {
    std::vector<double> area(mesh.triangles.size());
    for (std::uint32_t t = 0; t < area.size(); ++t) area[t] = area_of(mesh, t);
    std::partial_sum(area.begin(), area.end(), area.begin());
    const double lift = 1e-6 * std::sqrt(area.back());
    Random random(1, 2);
    std::vector<RTCRay> rays;
    rays.reserve(ray_count);
    while (rays.size() < ray_count) {
        const auto t = static_cast<std::uint32_t>(
            std::ranges::lower_bound(area, random.next() * area.back()) - area.begin());
        const auto& v = mesh.triangles[t].vertices;
        double a = random.next(), b = random.next();
        if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
        const glm::dvec3& p = mesh.positions[v[0]];
        const glm::dvec3 n = normal_of(mesh, t);
        const glm::dvec3 at =
            p + a * (mesh.positions[v[1]] - p) + b * (mesh.positions[v[2]] - p) + lift * n;
        const glm::dvec3 d = n + uniform_direction(random.next(), random.next());
        rays.push_back(make_ray(at, glm::normalize(d)));
    }
    return rays;
}

/// A parallel bundle, row by row.
std::vector<RTCRay> coherent_rays(const SurfaceMesh& mesh) {
    glm::dvec3 low(mesh.positions.front()), high(low);
    for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
    const glm::dvec3 centre = 0.5 * (low + high);
    const double radius = 0.5 * glm::length(high - low);
    const Bundle bundle = sample_bundle(5, 1);
    const int edge = static_cast<int>(std::sqrt(static_cast<double>(ray_count)));
    std::vector<RTCRay> rays;
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x) {
            const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / static_cast<double>(edge) - 0.5;
            rays.push_back(make_ray(centre + radius * (at.x * bundle.frame[0] +
                                                       at.y * bundle.frame[1] - bundle.frame[2]),
                                    bundle.frame[2]));
        }
    return rays;
}

class EmbreeScene {
public:
    explicit EmbreeScene(const SurfaceMesh& mesh) : device_(rtcNewDevice(nullptr)) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size()));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            for (int k = 0; k < 3; ++k)
                vertices[3 * i + k] = static_cast<float>(mesh.positions[i][k]);
        auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (int k = 0; k < 3; ++k) indices[3 * i + k] = mesh.triangles[i].vertices[k];
        rtcCommitGeometry(geometry);
        scene_ = rtcNewScene(device_);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    /// One at a time. \returns rays a second
    [[nodiscard]] double trace(const std::vector<RTCRay>& rays, const Workers& workers) const {
        const double seconds = seconds_of([&] {
            workers.for_ranges(rays.size(), 4096, [&](std::size_t begin, std::size_t end, int) {
                RTCIntersectContext context;
                rtcInitIntersectContext(&context);
                for (std::size_t i = begin; i < end; ++i) {
                    RTCRayHit ray{rays[i], {}};
                    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                    rtcIntersect1(scene_, &context, &ray);
                    asm volatile("" : : "m"(ray));
                }
            });
        });
        return static_cast<double>(rays.size()) / seconds;
    }

private:
    RTCDevice device_;
    RTCScene scene_{};
};

/// A scene, and what was measured in it, round by round.
struct Measured {
    explicit Measured(std::string name, const SurfaceMesh& surface)
        : name(std::move(name)),
          mesh(surface),
          patches(subdivide_to_levels(std::vector<int>(mesh.triangles.size(), 0))),
          embree(mesh),
          incoherent(incoherent_rays(mesh)),
          coherent(coherent_rays(mesh)) {}

    void measure(std::uint64_t directions, const Workers& workers) {
        PatchSources sources;
        sources.emission.assign(patches.patch_count(), Spectrum(1.0f));
        sources.direct.assign(patches.patch_count(), Spectrum(0.0f));
        sources.albedo.assign(patches.patch_count(), Spectrum(0.5f));
        IterationOptions options;
        options.iterations = directions;
        options.pixel_size = pixel_size_for(mesh, window);
        Monitor silent;
        TransportResult result;
        const double seconds =
            seconds_of([&] { result = iterate(mesh, patches, sources, options, workers, silent); });
        const auto fragments = static_cast<double>(result.fragments);
        fragments_a_second.push_back(fragments / seconds);
        direction_seconds.push_back(seconds / static_cast<double>(directions));
        const StageSeconds& s = result.seconds;
        const double all = seconds * workers.count();
        const double rest = all - s.project - s.bin - s.rasterize - s.sort - s.visit;
        const double stages[] = {s.project, s.bin, s.rasterize, s.sort, s.visit, rest};
        for (std::size_t i = 0; i < stage_ns.size(); ++i)
            stage_ns[i].push_back(1e9 * stages[i] / fragments);
        incoherent_a_second.push_back(embree.trace(incoherent, workers));
        coherent_a_second.push_back(embree.trace(coherent, workers));
    }

    void print(double hertz, int threads) const {
        const double fragments = median(fragments_a_second);
        fmt::print("{},{},{:.4g},{:.4g},{:.1f}", name, mesh.triangles.size(),
                   1e3 * median(direction_seconds), fragments, threads * hertz / fragments);
        for (const auto& ns : stage_ns) fmt::print(",{:.2f}", median(ns));
        const double incoherent_rays = median(incoherent_a_second),
                     coherent_rays = median(coherent_a_second);
        fmt::print(",{:.4g},{:.4g},{:.1f},{:.1f}\n", incoherent_rays, coherent_rays,
                   fragments / incoherent_rays, fragments / coherent_rays);
        std::fflush(stdout);
    }

    std::string name;
    SurfaceMesh mesh;
    PatchHierarchy patches;
    EmbreeScene embree;
    std::vector<RTCRay> incoherent, coherent;
    std::vector<double> fragments_a_second, direction_seconds, incoherent_a_second,
        coherent_a_second;
    std::array<std::vector<double>, 6> stage_ns;
};

int run(int argc, char** argv) {
    int rounds = 5, threads = 2;
    std::uint64_t directions = 64;
    std::vector<std::string> paths;
    CLI::App app("Fragments a second of the transport, by stage, beside rays of Embree. CSV.");
    app.add_option("SCENE", paths, "scenes; none: rooms of spheres");
    app.add_option("--rounds", rounds, "figures are medians over so many")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app.add_option("--directions", directions, "of each round")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 20))
        ->capture_default_str();
    app.add_option("--threads", threads)->check(CLI::Range(1, 1024))->capture_default_str();
    CLI11_PARSE(app, argc, argv);

    std::vector<std::unique_ptr<Measured>> scenes;
    Monitor silent;
    for (const std::string& path : paths)
        scenes.push_back(
            std::make_unique<Measured>(std::filesystem::path(path).stem().string(),
                                       build_surface(load_scene(path, {}, silent), {}, silent)));
    if (paths.empty())
        for (const auto& [spheres, rings] : {std::pair{1, 4}, {2, 16}, {4, 15}, {4, 39}, {4, 75}})
            scenes.push_back(
                std::make_unique<Measured>(fmt::format("{} spheres", spheres * spheres * spheres),
                                           room_of_spheres(spheres, rings)));
    const Workers workers(threads);
    std::vector<double> hertz;
    for (int round = 0; round < rounds; ++round) {
        hertz.push_back(clock_hertz());
        for (const auto& scene : scenes) {
            scene->measure(directions, workers);
            std::fprintf(stderr, "round %d of %d: %s\n", round + 1, rounds, scene->name.c_str());
        }
    }
    fmt::print(
        "scene,triangles,ms_per_direction,fragments_per_s,cycles_per_fragment,ns_project,ns_bin,"
        "ns_rasterize,ns_sort,ns_exchange,ns_accumulate,incoherent_per_s,coherent_per_s,"
        "ratio_incoherent,ratio_coherent\n");
    for (const auto& scene : scenes) scene->print(median(hertz), threads);
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bench_throughput: %s\n", e.what());
        return EXIT_FAILURE;
    }
}
