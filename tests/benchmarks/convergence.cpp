// Error against seconds and against directions, for variants of the method and for the path tracer
// of `reference`, in one run, at several seeds.
//
//   bench_convergence SCENE... > convergence.csv
//
// A row is a scene, a method and a count (directions; of `reference`, paths a pixel; it shares what
// they find between neighbouring pixels, "own paths" does not):
//   bake_seconds, render_seconds          means over the seeds
//   image_error, image_low, image_high    relative RMSE of the picture, without pixels that see an
//                                         emitter: mean over seeds, and its 95 % confidence
//                                         interval
//   image_bias, image_spread              RMS of what seeds have in common and of what they don't
//   leaf_error ... leaf_spread            the same of the leaves' irradiance, area-weighted,
//   against
//                                         a long run on the same leaves; none of refined leaves,
//                                         which differ from seed to seed, nor of `reference`
// The picture's truth is path-traced, twice; how far these two are apart tells its own noise
// (stderr), which is taken out of the errors. Light samples are chosen by the seed, too: their
// spread is part of the rest. The summary (stderr) tells the seconds to an error: between counts by
// interpolation, and of `reference`, which has no bias, beyond them as its noise falls, with the
// root of the paths.
#include "benchmarks/clock.h"
#include "benchmarks/errors.h"
#include "benchmarks/measured_scene.h"
#include "benchmarks/variants.h"

#include <transillum/geometry/surface_mesh.h>
#include <transillum/render/path_trace.h>
#include <transillum/repair/repair_scene.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

namespace {

using namespace transillum;
using namespace transillum::benchmarks;

constexpr std::uint64_t seed_of_truth = 1001;
constexpr const char* own_paths = "reference, own paths";

struct Arguments {
    std::vector<std::string> scenes, methods;
    View view;
    int seeds = 5, light_samples = 0, threads = 2, truth_samples = 4096, most_samples = 256;
    std::uint32_t leaves = 0;
    std::uint64_t least = 16, most = 1024, truth_directions = 16384;
    double level = 0.02;

    [[nodiscard]] bool wants(const std::string& name) const {
        return methods.empty() || std::any_of(methods.begin(), methods.end(),
                                              [&](const std::string& m) { return name == m; });
    }
};

/// What was measured of one method and count.
struct Row {
    std::uint64_t count = 0;
    double bake_seconds = 0.0, render_seconds = 0.0;
    std::uint32_t leaves = 0;
    SeedErrors image;
    std::optional<SeedErrors> leaf;
};

std::string errors_as_csv(const SeedErrors& e) {
    return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}", e.error.mean, e.error.low,
                       e.error.high, e.bias, e.spread);
}

/// Seconds until an error is reached, by interpolation between powers. \returns infinity where it
/// is not
double seconds_to(const std::vector<Row>& rows, double level) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double seconds = rows[i].bake_seconds + rows[i].render_seconds;
        const double error = rows[i].image.error.mean;
        if (error > level) continue;
        if (i == 0) return seconds;
        const double before = rows[i - 1].bake_seconds + rows[i - 1].render_seconds;
        const double error_before = rows[i - 1].image.error.mean;
        return before * std::pow(seconds / before,
                                 std::log(error_before / level) / std::log(error_before / error));
    }
    return std::numeric_limits<double>::infinity();
}

/// The same of what has no bias, beyond its last row, too.
double seconds_of_unbiased_to(const std::vector<Row>& rows, double level) {
    const double among = seconds_to(rows, level);
    if (std::isfinite(among)) return among;
    const double over = rows.back().image.error.mean / level;
    return rows.back().render_seconds * over * over;
}

/// Exponent of a leaf error that falls as a power of the directions, from its first to its last.
double fall(const std::vector<Row>& rows) {
    const Row &first = rows.front(), &last = rows.back();
    return std::log(last.leaf->error.mean / first.leaf->error.mean) /
           std::log(static_cast<double>(last.count) / static_cast<double>(first.count));
}

class Convergence {
public:
    Convergence(const Arguments& a, const std::string& path, const Workers& workers)
        : arguments_(a),
          workers_(workers),
          name_(std::filesystem::path(path).stem().string()),
          scene_(load_measured_scene(path)) {
        common_.subdivision.leaf_target = a.leaves;
        common_.light.samples = a.light_samples;
        RepairOptions repair;
        repair.rounding = Rounding::dyadic;
        surface_ =
            build_surface(repair_scene(scene_, repair, workers_, silent_).scene, {}, silent_);
        camera_ = camera_of(a.view, scene_.cameras, surface_);
        make_truth();
    }

    void measure() {
        for (const bool shares : {false, true}) {
            const char* const name = shares ? "reference" : own_paths;
            if (arguments_.wants(name)) sum_up(name, measure_reference(name, shares));
        }
        for (const Variant& v : all_variants())
            if (arguments_.wants(v.name)) sum_up(v.name, measure_variant(v));
    }

private:
    void make_truth() {
        std::fprintf(stderr, "%s: truth ...", name_.c_str());
        const int samples = arguments_.truth_samples / 2;
        truth_ = truth_of(trace(samples, seed_of_truth), trace(samples, seed_of_truth + 1));
        std::fprintf(stderr, "\r%s: truth's noise %.2f %%\n", name_.c_str(), 100.0 * truth_.noise);
    }

    Image trace(int samples, std::uint64_t seed, bool shares = true) {
        PathTraceOptions options;
        options.width = arguments_.view.width;
        options.height = arguments_.view.height;
        options.samples = samples;
        options.seed = seed;
        options.shares_paths = shares;
        return path_trace(surface_, scene_.lighting, camera_, options, workers_, silent_);
    }

    std::vector<Row> measure_reference(const char* name, bool shares) {
        std::vector<Row> rows;
        for (int samples = 1; samples <= arguments_.most_samples; samples *= 2) {
            Row row;
            row.count = static_cast<std::uint64_t>(samples);
            std::vector<Image> images;
            const Clock clock;
            for (int seed = 1; seed <= arguments_.seeds; ++seed)
                images.push_back(trace(samples, static_cast<std::uint64_t>(seed), shares));
            row.render_seconds = clock.seconds() / arguments_.seeds;
            row.image = image_errors(images, truth_);
            print(name, row);
            rows.push_back(row);
        }
        return rows;
    }

    std::vector<Row> measure_variant(const Variant& v) {
        std::optional<LeafField> truth;
        if (v.refinement == 0 && arguments_.truth_directions > 0) truth = leaf_truth(v);
        std::vector<Row> rows;
        for (std::uint64_t n = arguments_.least; n <= arguments_.most; n *= 2) {
            Row row;
            row.count = n;
            std::vector<Image> images;
            std::vector<std::vector<double>> leaves;
            for (int seed = 1; seed <= arguments_.seeds; ++seed) {
                BakeOptions options = common_;
                options.seed = static_cast<std::uint64_t>(seed);
                const Clock baking;
                const Solution solution = bake_variant(v, n, scene_, options, workers_);
                row.bake_seconds += baking.seconds() / arguments_.seeds;
                const Clock looking;
                images.push_back(render_variant(v, n, solution, arguments_.view, workers_));
                row.render_seconds += looking.seconds() / arguments_.seeds;
                row.leaves = solution.patches.leaf_count;
                if (truth) leaves.push_back(irradiance_of(solution).values);
            }
            row.image = image_errors(images, truth_);
            if (truth) row.leaf = leaf_errors(leaves, *truth);
            print(v.name, row);
            rows.push_back(row);
        }
        return rows;
    }

    /// Of the method that converges fastest, of two seeds.
    LeafField leaf_truth(const Variant& v) {
        Variant best = v;
        best.averaging = Averaging::balanced;
        if (v.averaging == Averaging::none) best.carried = MonteCarlo::off;
        LeafField sum;
        for (const std::uint64_t seed : {seed_of_truth, seed_of_truth + 1}) {
            BakeOptions options = common_;
            options.seed = seed;
            LeafField one = irradiance_of(
                bake_variant(best, arguments_.truth_directions, scene_, options, workers_));
            if (sum.values.empty()) {
                sum = std::move(one);
                continue;
            }
            for (std::size_t p = 0; p < sum.values.size(); ++p)
                sum.values[p] = 0.5 * (sum.values[p] + one.values[p]);
        }
        return sum;
    }

    void print(const char* method, const Row& row) {
        fmt::print("{},\"{}\",{},{},{},{:.4f},{:.4f},{},{}\n", name_, method, row.count,
                   arguments_.seeds, row.leaves, row.bake_seconds, row.render_seconds,
                   errors_as_csv(row.image), row.leaf ? errors_as_csv(*row.leaf) : ",,,,");
        std::fflush(stdout);
        std::fprintf(stderr, "%s, %s: %llu: image %.3f %%\n", name_.c_str(), method,
                     static_cast<unsigned long long>(row.count), 100.0 * row.image.error.mean);
    }

    void sum_up(const char* method, const std::vector<Row>& rows) {
        if (rows.empty()) return;
        const bool is_reference = std::string_view(method).starts_with("reference");
        const double seconds = is_reference ? seconds_of_unbiased_to(rows, arguments_.level)
                                            : seconds_to(rows, arguments_.level);
        std::fprintf(stderr, "%s, %s: %.4g s to %.3g %%", name_.c_str(), method, seconds,
                     100.0 * arguments_.level);
        if (is_reference) {
            references_.emplace_back(method, seconds);
        } else if (std::isfinite(seconds)) {
            for (const auto& [name, of_reference] : references_)
                std::fprintf(stderr, "; %s over that: %.3g, over a picture of it alone: %.3g",
                             name.c_str(), of_reference / seconds,
                             of_reference / rows.back().render_seconds);
        }
        if (rows.front().leaf && rows.size() > 1)
            std::fprintf(stderr, "; leaf error falls as m^%.2f", fall(rows));
        std::fputc('\n', stderr);
    }

    const Arguments& arguments_;
    const Workers& workers_;
    Monitor silent_;
    std::string name_;
    Scene scene_;
    BakeOptions common_;
    SurfaceMesh surface_;
    Camera camera_;
    ImageTruth truth_;
    std::vector<std::pair<std::string, double>> references_;  ///< seconds to the level
};

int run(const Arguments& a) {
    const Workers workers(a.threads);
    fmt::print(
        "scene,method,count,seeds,leaves,bake_seconds,render_seconds,image_error,image_low,"
        "image_high,image_bias,image_spread,leaf_error,leaf_low,leaf_high,leaf_bias,"
        "leaf_spread\n");
    for (const std::string& scene : a.scenes) Convergence(a, scene, workers).measure();
    return EXIT_SUCCESS;
}

std::string names_of_methods() {
    std::string names = fmt::format("reference, \"{}\"", own_paths);
    for (const Variant& v : all_variants()) names += fmt::format(", \"{}\"", v.name);
    return names;
}

/// --eye, --look-at, --up and --fov, of scenes from files without a camera.
struct FreeView {
    std::vector<double> eye, look_at, up{0.0, 1.0, 0.0};
    double fov = 45.0;

    void add_to(CLI::App& program) {
        const auto vector = [&](const char* name, std::vector<double>& value) {
            return program.add_option(name, value)->expected(3)->delimiter(',')->type_name("X,Y,Z");
        };
        auto* const at = vector("--look-at", look_at);
        vector("--eye", eye)->needs(at);
        vector("--up", up)->needs(at)->capture_default_str();
        program.add_option("--fov", fov, "vertical [degrees]")->needs(at)->capture_default_str();
    }

    [[nodiscard]] std::optional<Camera> camera() const {
        if (eye.empty()) return std::nullopt;
        const auto point = [](const std::vector<double>& v) {
            return glm::dvec3(v[0], v[1], v[2]);
        };
        Camera camera;
        camera.eye = point(eye);
        camera.look_at = point(look_at);
        camera.up = point(up);
        camera.vertical_fov = fov;
        return camera;
    }
};

}  // namespace

int main(int argc, char** argv) try {
    Arguments a;
    FreeView free;
    CLI::App program(
        "Error against seconds and directions, at several seeds. CSV on stdout, progress and a "
        "summary on stderr.");
    program.add_option("SCENE", a.scenes)->required();
    program.add_option("--method", a.methods, "only these, by name: " + names_of_methods());
    program.add_option("--camera", a.view.camera, "empty: the scene's first");
    free.add_to(program);
    program.add_option("--width", a.view.width)->check(CLI::PositiveNumber)->capture_default_str();
    program.add_option("--height", a.view.height)
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    program.add_option("--seeds", a.seeds)->check(CLI::Range(1, 1000))->capture_default_str();
    program.add_option("--leaves", a.leaves, "0: as bake chooses")->capture_default_str();
    program.add_option("--light-samples", a.light_samples, "0: as bake chooses")
        ->capture_default_str();
    program.add_option("--least", a.least, "directions, doubled ...")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    program.add_option("--most", a.most, "... up to these")->capture_default_str();
    program
        .add_option("--most-samples", a.most_samples, "paths a pixel, from 1 doubled up to these")
        ->capture_default_str();
    program.add_option("--truth-samples", a.truth_samples, "paths a pixel of the picture's truth")
        ->check(CLI::Range(2, 1 << 24))
        ->capture_default_str();
    program
        .add_option("--truth-directions", a.truth_directions,
                    "of the leaves' truth, twice; 0: leaves are not compared")
        ->capture_default_str();
    program.add_option("--level", a.level, "image error for which the summary tells the seconds")
        ->capture_default_str();
    program.add_option("--threads", a.threads, "0: all")->capture_default_str();
    CLI11_PARSE(program, argc, argv);
    a.view.free = free.camera();
    return run(a);
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_convergence: %s\n", e.what());
    return EXIT_FAILURE;
}
