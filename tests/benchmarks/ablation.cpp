// What each part of the method buys: error of a picture against directions and against seconds, for
// plain ray-bundle iteration and for what the paper adds to it, one part after the other.
//
//   bench_ablation SCENE REFERENCE.exr [CAMERA [LEAVES [LIGHT_SAMPLES [VARIANT]]]] > ablation.csv
//
// The reference is what `transillum reference SCENE --camera CAMERA` made; its noise is part of
// every error. VARIANT: only those with that in their name. Seconds: of the bake and of the
// picture.
#include "benchmarks/clock.h"
#include "benchmarks/errors.h"
#include "benchmarks/measured_scene.h"
#include "benchmarks/variants.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace {

using namespace transillum;
using namespace transillum::benchmarks;

constexpr std::uint64_t least_directions = 64;

int run(int argc, char** argv) {
    if (argc < 3) {
        std::fputs(
            "bench_ablation SCENE REFERENCE.exr [CAMERA [LEAVES [LIGHT_SAMPLES [VARIANT]]]]\n",
            stderr);
        return EXIT_FAILURE;
    }
    const Scene scene = load_measured_scene(argv[1]);
    const Image reference = read_image(argv[2]);
    const View view{argc > 3 ? argv[3] : "", reference.width, reference.height};
    BakeOptions options;
    if (argc > 4) options.subdivision.leaf_target = static_cast<std::uint32_t>(std::atoi(argv[4]));
    if (argc > 5) options.light.samples = std::atoi(argv[5]);
    const Workers workers(2);
    fmt::print("variant,directions,leaves,bake_seconds,render_seconds,bias,rmse\n");
    const std::string chosen = argc > 6 ? argv[6] : "";
    for (const Variant& v : all_variants()) {
        if (std::string(v.name).find(chosen) == std::string::npos) continue;
        for (std::uint64_t n = least_directions; n <= v.most_directions; n *= 4) {
            const Clock baking;
            const Solution solution = bake_variant(v, n, scene, options, workers);
            const double bake_seconds = baking.seconds();
            const Clock looking;
            const Image image = render_variant(v, n, solution, view, workers);
            const double render_seconds = looking.seconds();
            const ImageDifference error = compare_images(image, reference);
            fmt::print("\"{}\",{},{},{:.3f},{:.3f},{:.5f},{:.5f}\n", v.name, n,
                       solution.patches.leaf_count, bake_seconds, render_seconds, error.bias,
                       error.relative_rmse);
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
