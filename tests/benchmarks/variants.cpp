#include "benchmarks/variants.h"

namespace transillum::benchmarks {

const std::vector<Variant>& all_variants() {
    static const std::vector<Variant> variants{
        {"plain bundles", FirstShot::off, Averaging::none, MonteCarlo::off, MonteCarloShading::off,
         0},
        {"+ first shot", FirstShot::hemicube, Averaging::none, MonteCarlo::off,
         MonteCarloShading::off, 0},
        {"+ finite elements, 1/m", FirstShot::hemicube, Averaging::paper, MonteCarlo::off,
         MonteCarloShading::off, 0},
        {"+ finite elements", FirstShot::hemicube, Averaging::balanced, MonteCarlo::off,
         MonteCarloShading::off, 0},
        {"+ finite elements, stored light", FirstShot::hemicube, Averaging::balanced,
         MonteCarlo::off, MonteCarloShading::off, 0, DirectShading::stored},
        {"+ subpatch", FirstShot::hemicube, Averaging::balanced, MonteCarlo::subpatch,
         MonteCarloShading::subpatch, 0},
        {"+ wavefront", FirstShot::hemicube, Averaging::balanced, MonteCarlo::wavefront,
         MonteCarloShading::wavefront, 0},
        {"subpatch in the picture alone", FirstShot::hemicube, Averaging::balanced, MonteCarlo::off,
         MonteCarloShading::subpatch, 0},
        {"rays in the picture", FirstShot::hemicube, Averaging::balanced, MonteCarlo::off,
         MonteCarloShading::rays, 0},
        {"+ refinement, rays", FirstShot::hemicube, Averaging::balanced, MonteCarlo::off,
         MonteCarloShading::rays, 2},
        {"+ refinement, subpatch", FirstShot::hemicube, Averaging::balanced, MonteCarlo::subpatch,
         MonteCarloShading::subpatch, 2},
    };
    return variants;
}

Solution bake_variant(const Variant& v, std::uint64_t directions, const Scene& scene,
                      const BakeOptions& common, const Workers& workers) {
    Monitor silent;
    BakeOptions options = common;
    options.light.first_shot = v.first_shot;
    options.iteration.averaging = v.averaging;
    options.iteration.monte_carlo = v.carried;
    options.iteration.iterations = directions;
    options.refinement.phases = v.refinement;
    options.refinement.direct = v.direct == DirectShading::stored;
    return bake(scene, options, workers, silent);
}

Camera camera_of(const View& view, const std::vector<Camera>& cameras, const SurfaceMesh& surface) {
    return view.free ? *view.free : choose_camera(cameras, surface, view.camera);
}

Image render_variant(const Variant& v, std::uint64_t directions, const Solution& solution,
                     const View& view, const Workers& workers) {
    Monitor silent;
    RenderOptions options;
    options.width = view.width;
    options.height = view.height;
    options.monte_carlo = v.shown;
    options.direct = v.direct;
    const bool shows_bundles =
        v.shown == MonteCarloShading::subpatch || v.shown == MonteCarloShading::wavefront;
    if (shows_bundles) options.iterations = static_cast<int>(directions);
    options.seed = solution.seed;
    return render_solution(solution, camera_of(view, solution.cameras, solution.surface), options,
                           workers, silent);
}

}  // namespace transillum::benchmarks
