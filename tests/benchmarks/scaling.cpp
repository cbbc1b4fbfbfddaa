// Time and peak memory against what a bake's size is made of, each alone.
//
//   bench_scaling > scaling.csv
//
// A row is a series and its value; each bake has a process of its own, so that its peak is:
//   triangles       of a room with 64 spheres in it, a leaf each
//   leaves          of a room with 64 coarse spheres
//   light_samples   of a first shot from two triangles
//   bins            direction bins of glossy walls and spheres
//   resolution      pixels across the transillumination buffer
//   threads         of 97 000 triangles
// seconds_*: of geometry, first shot and transport; seconds_per_direction: of the transport;
// peak_mb: of the whole process [10^6 bytes], the scene as it was read among them; mb_allowed: 250
// bytes a leaf, 150 a triangle and 200 MB, which diffuse scenes are to stay below.
#include "benchmarks/scenes.h"

#include <transillum/solution/bake.h>
#include <transillum/transport/direction_bins.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace transillum;
using namespace transillum::benchmarks;

struct Arguments {
    std::vector<std::string> series;
    std::uint64_t directions = 64;
    double most_triangles = 4.1e6;
    int threads = 2;
};

/// One bake.
struct Case {
    const char* series;
    double value = 0.0;  ///< 0: what came out, of triangles and leaves
    int rings = 6;       ///< of each of 64 spheres
    std::uint32_t leaves = 1;
    int samples = 0;  ///< of the first shot; 0: none
    int bin_level = 0;
    int resolution = 1000;
    int threads = 2;
};

constexpr int spheres = 4;
constexpr int rings_of_97k = 20;

std::vector<Case> cases_of(const Arguments& a) {
    std::vector<Case> cases;
    const int t = a.threads;
    for (const int rings : {3, 6, 14, 20, 40, 63, 126})
        if (256.0 * rings * (rings - 1) <= a.most_triangles)
            cases.push_back({.series = "triangles", .rings = rings, .threads = t});
    for (const std::uint32_t leaves : {10'000u, 40'000u, 160'000u, 640'000u, 2'560'000u})
        cases.push_back({.series = "leaves", .leaves = leaves, .threads = t});
    for (const int samples : {1, 4, 16, 64})
        cases.push_back({.series = "light_samples",
                         .value = double(samples),
                         .leaves = 40'000,
                         .samples = samples,
                         .threads = t});
    for (int level = 0; level <= max_bin_level; ++level)
        cases.push_back({.series = "bins",
                         .value = double(bin_count(level)),
                         .leaves = 40'000,
                         .bin_level = level,
                         .threads = t});
    for (const int pixels : {250, 500, 1000, 2000, 4000})
        cases.push_back({.series = "resolution",
                         .value = double(pixels),
                         .leaves = 40'000,
                         .resolution = pixels,
                         .threads = t});
    for (int threads = 1; threads <= Workers(0).count(); threads *= 2)
        cases.push_back({.series = "threads",
                         .value = double(threads),
                         .rings = rings_of_97k,
                         .threads = threads});
    return cases;
}

Scene scene_of(const Case& c) {
    Scene scene = scene_of_spheres(spheres, c.rings);
    Material& all = scene.materials[0];
    if (std::string_view(c.series) == "bins") {
        all.lobe = Lobe::max_phong;
        all.specular = Spectrum(0.3f);
        all.shininess = 20.0f;
    }
    if (c.samples > 0) {  // the first polygon of the room is the luminaire
        Material dark = all;
        dark.emission = Spectrum(0.0f);
        scene.materials.push_back(dark);
        for (std::size_t i = 1; i < scene.polygons.size(); ++i) scene.polygons[i].material = 1;
    }
    return scene;
}

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024.0 * 1e-6;
}

double seconds_of(const RunRecord& run, std::string_view phase) {
    for (const auto& [name, seconds] : run.seconds)
        if (name == phase) return seconds;
    return 0.0;
}

void measure(const Case& c, std::uint64_t directions) {
    const Scene scene = scene_of(c);
    BakeOptions options;
    options.repair.level = RepairLevel::off;
    options.subdivision.leaf_target = c.leaves;
    options.light.first_shot = c.samples > 0 ? FirstShot::hemicube : FirstShot::off;
    options.light.samples = std::max(1, c.samples);
    options.bins.level = c.bin_level;
    options.resolution = c.resolution;
    options.iteration.iterations = directions;
    Monitor silent;
    RunRecord run;
    const Solution s = bake(scene, options, Workers(c.threads), silent, &run);
    const auto triangles = static_cast<double>(s.surface.triangles.size());
    const auto leaves = static_cast<double>(s.patches.leaf_count);
    const double value = std::string_view(c.series) == "triangles" ? triangles
                         : std::string_view(c.series) == "leaves"  ? leaves
                                                                   : c.value;
    const double transport = seconds_of(run, "transport");
    fmt::print("{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.6f},{:.1f},{:.1f}\n", c.series, value,
               triangles, leaves, c.samples, c.resolution, c.threads, seconds_of(run, "geometry"),
               seconds_of(run, "first shot"), transport,
               transport / static_cast<double>(directions), peak_megabytes(),
               250e-6 * leaves + 150e-6 * triangles + 200.0);
    std::fflush(stdout);
}

void measure_apart(const Case& c, std::uint64_t directions) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        try {
            measure(c, directions);
        } catch (const std::exception& e) {
            std::fprintf(stderr, "%s: %s\n", c.series, e.what());
        }
        std::_Exit(EXIT_SUCCESS);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (!WIFEXITED(status)) std::fprintf(stderr, "%s: ended by a signal\n", c.series);
}

int run(const Arguments& a) {
    fmt::print(
        "series,value,triangles,leaves,light_samples,resolution,threads,seconds_geometry,"
        "seconds_first_shot,seconds_transport,seconds_per_direction,peak_mb,mb_allowed\n");
    for (const Case& c : cases_of(a)) {
        if (!a.series.empty() &&
            std::find(a.series.begin(), a.series.end(), c.series) == a.series.end())
            continue;
        std::fprintf(stderr, "%s ...\n", c.series);
        measure_apart(c, a.directions);
    }
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) try {
    Arguments a;
    CLI::App program("Time and peak memory of bakes against their size. CSV on stdout.");
    program
        .add_option("--series", a.series,
                    "only these of triangles, leaves, light_samples, bins, resolution, threads")
        ->check(CLI::IsMember(
            {"triangles", "leaves", "light_samples", "bins", "resolution", "threads"}));
    program.add_option("--directions", a.directions)
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    program.add_option("--most-triangles", a.most_triangles)->capture_default_str();
    program.add_option("--threads", a.threads, "0: all; of all series but theirs")
        ->capture_default_str();
    CLI11_PARSE(program, argc, argv);
    return run(a);
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_scaling: %s\n", e.what());
    return EXIT_FAILURE;
}
