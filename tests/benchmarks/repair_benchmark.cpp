// What check and repair find, do, keep and cost.
//
//   bench_repair FILE... > table.txt
//
// One line a file. Seconds: of check (leaks are not looked for) and of repair, after loading. Peak:
// memory up to the end of the repair [MiB]. Harmful: counts of all harmful defects, and which are
// left. Hausdorff (sampled), area of the union (change, relative; what overlaps within the
// tolerance counts once) and largest move: whether the surface is the same one.
#include "benchmarks/clock.h"
#include "support/surface_distance.h"
#include "support/union_area.h"

#include <transillum/repair/check_scene.h>
#include <transillum/repair/repair_scene.h>
#include <transillum/scene/load_scene.h>

#include <fmt/format.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

namespace {

using namespace transillum;
using benchmarks::Clock;
using namespace transillum::testing_support;

double peak_mebibytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

struct Harm {
    std::uint64_t count = 0;
    std::string which;
};

Harm harm_in(const CheckReport& report) {
    Harm harm;
    for (std::size_t d = 0; d < defect_count; ++d) {
        if (!is_harmful(static_cast<Defect>(d)) || report.counts[d] == 0) continue;
        harm.count += report.counts[d];
        harm.which += fmt::format(" {}:{}", name_of(static_cast<Defect>(d)), report.counts[d]);
    }
    return harm;
}

constexpr std::uint64_t random_samples = 100000;

void measure(const char* path) {
    Monitor silent;
    const Workers workers(2);
    const Scene scene = load_scene(path, {}, silent);
    CheckOptions check;
    check.leaks = false;
    const Clock checking;
    const CheckReport before = check_scene(scene, check, workers, silent);
    const double check_seconds = checking.seconds();
    const Clock repairing;
    const RepairedScene repaired = repair_scene(scene, {}, workers, silent);
    const double repair_seconds = repairing.seconds();
    const double peak = peak_mebibytes();
    const CheckReport after = check_scene(repaired.scene, check, workers, silent);

    const TriangleSoup was = make_soup(scene), is = make_soup(repaired.scene);
    const SurfaceDistance distance = surface_distance(was, is, random_samples, workers);
    const double tolerance = RepairOptions{}.tolerance * before.diagonal;
    const UnionArea area = union_area(was, tolerance), area_after = union_area(is, tolerance);
    const RepairReport& r = repaired.report;
    const Harm harm = harm_in(before), left = harm_in(after);
    fmt::print(
        "{:28} {:>8} {:>8} {:>6} {:>7} {:>8.2f} {:>8.2f} {:>7.0f} {:>7} {:>6} {:>9.1e} "
        "{:>9.1e} {:>9.1e} {:>6} {:>5} {:s}\n",
        std::filesystem::path(path).filename().string(), before.triangles, after.triangles,
        r.crossing_pairs, r.coplanar_pairs, check_seconds, repair_seconds, peak, harm.count,
        left.count, std::max(distance.forth, distance.back) / before.diagonal,
        (area_after.covered - area.covered) / area.covered, r.largest_move / before.diagonal,
        r.rounds, r.pairs_left, left.which);
    std::fflush(stdout);
}

/// In a process of its own, so that its peak is.
void measure_apart(const char* path) {
    const pid_t child = fork();
    if (child == 0) {
        try {
            measure(path);
        } catch (const std::exception& e) {
            std::fprintf(stderr, "%s\n", e.what());
        }
        std::_Exit(EXIT_SUCCESS);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (!WIFEXITED(status)) std::fprintf(stderr, "%s: ended by a signal\n", path);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fputs("bench_repair FILE...\n", stderr);
        return EXIT_FAILURE;
    }
    std::puts(
        "file                            before    after crossg coplanr  check/s repair/s "
        "peak/MB harmful  after hausdorff      area      move rounds  left");
    std::fflush(stdout);
    for (int i = 1; i < argc; ++i) measure_apart(argv[i]);
    return EXIT_SUCCESS;
}
