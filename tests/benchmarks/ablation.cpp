// What each part of the method buys: error of a picture against directions and against seconds, for
// plain ray-bundle iteration and for what the paper adds to it, one part after the other.
//
//   bench_ablation SCENE REFERENCE.exr [CAMERA [LEAVES [LIGHT_SAMPLES [VARIANT]]]] > ablation.csv
//
// The reference is what `transillum reference SCENE --camera CAMERA` made; its noise is part of
// every error. VARIANT: only those with that in their name. Seconds: of the bake from the first
// shot on, and of the picture. Direct light of a first shot is traced in the picture, so that its
// own storage is no part of the errors.
#include <transillum/render/image.h>
#include <transillum/render/render_solution.h>
#include <transillum/scene/limit_albedo.h>
#include <transillum/scene/load_scene.h>
#include <transillum/solution/bake.h>

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace transillum;

struct Variant {
    const char* name;
    FirstShot first_shot;
    Averaging averaging;
    MonteCarlo carried;
    MonteCarloShading shown;
    int refinement;
    std::vector<std::uint64_t> directions;
};

const std::vector<std::uint64_t> octaves{64, 256, 1024};

const std::vector<Variant> variants{
    {"plain bundles",
     FirstShot::off,
     Averaging::none,
     MonteCarlo::off,
     MonteCarloShading::off,
     0,
     {64, 256, 1024, 4096}},
    {"+ first shot",
     FirstShot::hemicube,
     Averaging::none,
     MonteCarlo::off,
     MonteCarloShading::off,
     0,
     {64, 256, 1024, 4096}},
    {"+ finite elements, 1/m", FirstShot::hemicube, Averaging::paper, MonteCarlo::off,
     MonteCarloShading::off, 0, octaves},
    {"+ finite elements", FirstShot::hemicube, Averaging::balanced, MonteCarlo::off,
     MonteCarloShading::off, 0, octaves},
    {"+ subpatch", FirstShot::hemicube, Averaging::balanced, MonteCarlo::subpatch,
     MonteCarloShading::subpatch, 0, octaves},
    {"+ wavefront", FirstShot::hemicube, Averaging::balanced, MonteCarlo::wavefront,
     MonteCarloShading::wavefront, 0, octaves},
    {"subpatch in the picture alone", FirstShot::hemicube, Averaging::balanced, MonteCarlo::off,
     MonteCarloShading::subpatch, 0, octaves},
    {"rays in the picture", FirstShot::hemicube, Averaging::balanced, MonteCarlo::off,
     MonteCarloShading::rays, 0, octaves},
    {"+ refinement, rays", FirstShot::hemicube, Averaging::balanced, MonteCarlo::off,
     MonteCarloShading::rays, 2, octaves},
    {"+ refinement, subpatch", FirstShot::hemicube, Averaging::balanced, MonteCarlo::subpatch,
     MonteCarloShading::subpatch, 2, octaves},
};

struct Measured {
    double bake_seconds = 0.0, render_seconds = 0.0;
    std::uint32_t leaves = 0;
    ImageDifference error;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Measured measure(const Variant& v, std::uint64_t directions, const Scene& scene,
                 const BakeOptions& common, const std::string& camera, const Image& reference,
                 const Workers& workers) {
    Monitor silent;
    BakeOptions bake_options = common;
    bake_options.light.first_shot = v.first_shot;
    bake_options.iteration.averaging = v.averaging;
    bake_options.iteration.monte_carlo = v.carried;
    bake_options.iteration.iterations = directions;
    bake_options.refinement.phases = v.refinement;
    bake_options.refinement.direct = false;
    const auto start = std::chrono::steady_clock::now();
    const Solution solution = bake(scene, bake_options, workers, silent);
    Measured m;
    m.bake_seconds = seconds_since(start);
    m.leaves = solution.patches.leaf_count;

    RenderOptions render;
    render.width = reference.width;
    render.height = reference.height;
    render.monte_carlo = v.shown;
    render.iterations = static_cast<int>(directions);
    if (v.shown == MonteCarloShading::off) render.iterations = 1;
    const auto looked = std::chrono::steady_clock::now();
    const Image image =
        render_solution(solution, choose_camera(solution.cameras, solution.surface, camera), render,
                        workers, silent);
    m.render_seconds = seconds_since(looked);
    m.error = compare_images(image, reference);
    return m;
}

int run(int argc, char** argv) {
    if (argc < 3) {
        std::fputs(
            "bench_ablation SCENE REFERENCE.exr [CAMERA [LEAVES [LIGHT_SAMPLES [VARIANT]]]]\n",
            stderr);
        return EXIT_FAILURE;
    }
    Monitor silent;
    Scene scene = load_scene(argv[1], {}, silent);
    limit_albedo(scene, 0.99f, silent);
    const Image reference = read_image(argv[2]);
    const std::string camera = argc > 3 ? argv[3] : "";
    BakeOptions options;
    if (argc > 4) options.subdivision.leaf_target = static_cast<std::uint32_t>(std::atoi(argv[4]));
    if (argc > 5) options.light.samples = std::atoi(argv[5]);
    const Workers workers(2);
    fmt::print("variant,directions,leaves,bake_seconds,render_seconds,bias,rmse\n");
    const std::string chosen = argc > 6 ? argv[6] : "";
    for (const Variant& v : variants) {
        if (std::string(v.name).find(chosen) == std::string::npos) continue;
        for (const std::uint64_t directions : v.directions) {
            const Measured m = measure(v, directions, scene, options, camera, reference, workers);
            fmt::print("\"{}\",{},{},{:.3f},{:.3f},{:.5f},{:.5f}\n", v.name, directions, m.leaves,
                       m.bake_seconds, m.render_seconds, m.error.bias, m.error.relative_rmse);
            std::fflush(stdout);
        }
    }
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) try { return run(argc, argv); } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return EXIT_FAILURE;
}
