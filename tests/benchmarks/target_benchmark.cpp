// Accuracy asked for against accuracy got: bakes that stop at --target-error, at many seeds.
//
// A row of the CSV is one scene, target and seed:
//   directions   when it stopped
//   reported     relative error that it told of itself
//   error        the true one: of the indirect irradiance of the leaves, against the mean of two
//                runs of other seeds and many times the directions
//   oracle       directions after which the error was first within the target, at an end of a block
//   ratio        of both counts: time is in proportion
// With --curve, a row there is a scene and a count of directions: `error` is the root mean square
// of the true errors of all seeds, `reported` that of the reported ones, `spread` of the deviation
// from their common mean, `bias` what they have in common.
#include "benchmarks/errors.h"
#include "benchmarks/measured_scene.h"

#include <transillum/solution/bake.h>
#include <transillum/solution/patch_sources.h>
#include <transillum/transport/iterate.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>

namespace {

using namespace transillum;
using namespace transillum::benchmarks;

struct Arguments {
    std::vector<std::string> scenes;
    std::vector<double> targets{0.02, 0.01};
    std::uint32_t leaves = 2000;
    int light_samples = 0, seeds = 20, threads = 2;
    std::uint64_t most = 4096, truth = 32768;
    std::string curve, averaging = "balanced";
};

struct Run {
    std::vector<double> values;
    double reported = 0.0;
    std::uint64_t directions = 0;
};

/// A scene before its iteration, whose first shot is that of one seed.
class Prepared {
public:
    Prepared(const Scene& scene, const Arguments& a, std::uint64_t seed, const Workers& workers)
        : workers_(workers) {
        BakeOptions options;
        options.subdivision.leaf_target = a.leaves;
        options.light.samples = a.light_samples;
        options.seed = seed;
        options.iteration.iterations = 1;
        Monitor silent;
        solution_ = bake(scene, options, workers, silent);
        sources_ = make_sources(solution_);
        iteration_.pixel_size = automatic_pixel_size(solution_.surface, solution_.patches);
        iteration_.seed = seed;
        if (a.averaging == "paper") iteration_.averaging = Averaging::paper;
    }

    [[nodiscard]] Run run(std::uint64_t directions, double target) const {
        Monitor silent;
        IterationOptions options = iteration_;
        options.iterations = directions;
        options.target_error = target;
        const TransportResult result =
            iterate(solution_.surface, solution_.patches, sources_, options, workers_, silent);
        Run run{{}, result.relative_error, result.iterations};
        for (const Spectrum& e : result.irradiance) run.values.push_back(luminance(SpectrumSum(e)));
        return run;
    }

    [[nodiscard]] const Solution& solution() const { return solution_; }

private:
    const Workers& workers_;
    Solution solution_;
    PatchSources sources_;
    IterationOptions iteration_;
};

LeafField truth_of(const Scene& scene, const Arguments& a, const Workers& workers) {
    const Prepared one(scene, a, 1001, workers), other(scene, a, 1002, workers);
    const Run first = one.run(a.truth, 0.0), second = other.run(a.truth, 0.0);
    LeafField truth = irradiance_of(one.solution());
    for (std::size_t p = 0; p < truth.values.size(); ++p) {
        truth.values[p] = 0.5 * (first.values[p] + second.values[p]);
        const auto patch = static_cast<std::uint32_t>(p);
        truth.weights[p] = one.solution().reflects(patch)
                               ? area_of_leaf(one.solution().surface, one.solution().patches,
                                              one.solution().patches.leaf_of_patch(patch))
                               : 0.0;
    }
    std::fprintf(stderr, "%s: %u leaves, truth within about %.3f %%\n", scene.path.c_str(),
                 one.solution().patches.leaf_count,
                 50.0 * relative_rms(first.values, LeafField{second.values, truth.weights}));
    return truth;
}

/// Where blocks of directions end.
std::vector<std::uint64_t> block_ends(std::uint64_t most) {
    std::vector<std::uint64_t> ends;
    for (std::uint64_t octave = 32; octave < most; octave *= 2)
        for (std::uint64_t quarter = 0; quarter < 4; ++quarter)
            ends.push_back(octave + quarter * octave / 4);
    ends.push_back(most);
    return ends;
}

class Measurement {
public:
    Measurement(const Arguments& a, const Workers& workers, std::FILE* curve)
        : arguments_(a), workers_(workers), curve_(curve) {}

    void measure(const std::string& path) {
        const Scene scene = load_measured_scene(path);
        name_ = std::filesystem::path(path).stem().string();
        truth_ = truth_of(scene, arguments_, workers_);
        ends_ = block_ends(arguments_.most);
        by_end_.clear();
        for (int i = 1; i <= arguments_.seeds; ++i) {
            const auto seed = static_cast<std::uint64_t>(i);
            const Prepared prepared(scene, arguments_, seed, workers_);
            errors_.clear();
            if (curve_)
                for (const std::uint64_t end : ends_) (void)error_at(prepared, end);
            for (const double target : arguments_.targets) stop_at(prepared, target, seed);
            std::fprintf(stderr, "\r%s: seed %d of %d", name_.c_str(), i, arguments_.seeds);
        }
        std::fputc('\n', stderr);
        for (const double target : arguments_.targets) sum_up(target);
        if (curve_) print_curve();
    }

private:
    struct Stop {
        double error, reported, ratio;
    };

    double error_at(const Prepared& prepared, std::uint64_t end) {
        const auto known = errors_.find(end);
        if (known != errors_.end()) return known->second;
        Run run = prepared.run(end, 0.0);
        const double error = relative_rms(run.values, truth_);
        if (curve_) by_end_[end].push_back(std::move(run));
        return errors_[end] = error;
    }

    void stop_at(const Prepared& prepared, double target, std::uint64_t seed) {
        const Run run = prepared.run(arguments_.most, target);
        const double error = relative_rms(run.values, truth_);
        std::uint64_t oracle = arguments_.most;
        for (const std::uint64_t end : ends_)
            if (error_at(prepared, end) <= target) {
                oracle = end;
                break;
            }
        const double ratio = static_cast<double>(run.directions) / static_cast<double>(oracle);
        stops_[target].push_back({error, run.reported, ratio});
        fmt::print("{},{},{},{},{:.6f},{:.6f},{},{:.4f}\n", name_, target, seed, run.directions,
                   run.reported, error, oracle, ratio);
        std::fflush(stdout);
    }

    void sum_up(double target) {
        std::vector<Stop>& stops = stops_[target];
        int within = 0;
        double worst = 0.0, sum = 0.0, reported = 0.0, error = 0.0;
        for (const Stop& s : stops) {
            within += s.error <= target ? 1 : 0;
            worst = std::max(worst, s.ratio);
            sum += s.ratio;
            reported += s.reported * s.reported;
            error += s.error * s.error;
        }
        std::fprintf(stderr,
                     "%-20s target %-6g within %2d of %zu, time over the oracle's: mean %.2f, "
                     "largest %.2f; reported over true error %.2f\n",
                     name_.c_str(), target, within, stops.size(),
                     sum / static_cast<double>(stops.size()), worst, std::sqrt(reported / error));
        stops.clear();
    }

    void print_curve() {
        for (const auto& [end, runs] : by_end_) {
            std::vector<std::vector<double>> values;
            double reported = 0.0, square = 0.0;
            for (const Run& run : runs) {
                values.push_back(run.values);
                reported += run.reported * run.reported;
                square += std::pow(relative_rms(run.values, truth_), 2.0);
            }
            const auto n = static_cast<double>(runs.size());
            const SeedErrors e = leaf_errors(values, truth_);
            fmt::print(curve_, "{},{},{},{:.6f},{:.6f},{:.6f},{:.6f}\n", name_, end, runs.size(),
                       std::sqrt(square / n), std::sqrt(reported / n), e.spread, e.bias);
        }
        std::fflush(curve_);
    }

    const Arguments& arguments_;
    const Workers& workers_;
    std::FILE* curve_;
    std::string name_;
    LeafField truth_;
    std::vector<std::uint64_t> ends_;
    std::map<std::uint64_t, double> errors_;  ///< of one seed
    std::map<std::uint64_t, std::vector<Run>> by_end_;
    std::map<double, std::vector<Stop>> stops_;
};

int run(const Arguments& a) {
    const Workers workers(a.threads);
    std::FILE* curve = a.curve.empty() ? nullptr : std::fopen(a.curve.c_str(), "w");
    if (!a.curve.empty() && !curve) throw std::runtime_error(a.curve + ": cannot be written");
    if (curve) fmt::print(curve, "scene,directions,seeds,error,reported,spread,bias\n");
    fmt::print("scene,target,seed,directions,reported,error,oracle,ratio\n");
    Measurement measurement(a, workers, curve);
    for (const std::string& scene : a.scenes) measurement.measure(scene);
    if (curve) std::fclose(curve);
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) try {
    Arguments a;
    CLI::App program("Accuracy asked for by --target-error against accuracy got. CSV on stdout.");
    program.add_option("SCENE", a.scenes)->required();
    program.add_option("--target", a.targets, "relative errors asked for")->capture_default_str();
    program.add_option("--seeds", a.seeds)->check(CLI::Range(1, 1000))->capture_default_str();
    program.add_option("--leaves", a.leaves)->capture_default_str();
    program.add_option("--light-samples", a.light_samples, "0: as bake chooses")
        ->capture_default_str();
    program.add_option("--most", a.most, "directions, a power of two")->capture_default_str();
    program.add_option("--truth", a.truth, "directions of each of two runs")->capture_default_str();
    program.add_option("--curve", a.curve, "also write the error at every end of a block here");
    program.add_option("--averaging", a.averaging)
        ->check(CLI::IsMember({"balanced", "paper"}))
        ->capture_default_str();
    program.add_option("--threads", a.threads, "0: all")->capture_default_str();
    CLI11_PARSE(program, argc, argv);
    return run(a);
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_target: %s\n", e.what());
    return EXIT_FAILURE;
}
