// Frames a second of a solution that was made ready once: bench_render [SOLUTION.vtm ...], for
// every camera of each; without one, of the Cornell box.
#include <transillum/render/render_solution.h>
#include <transillum/scene/load_scene.h>
#include <transillum/solution/bake.h>
#include <transillum/solution/load_solution.h>

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace {

using namespace transillum;

constexpr int threads = 2;
constexpr int size = 500;

struct Measured {
    std::string name;
    Solution solution;
};

Measured cornell_box() {
    Monitor silent;
    const Scene scene = load_scene(TRANSILLUM_SOURCE_DIR "/data/scenes/cornell.gltf", {}, silent);
    BakeOptions options;
    options.iteration.iterations = 64;
    options.light.samples = 18;
    return {"cornell", bake(scene, options, Workers(threads), silent)};
}

struct View {
    const char* name;
    int samples;
    bool monte_carlo;
    int iterations;
    DirectShading direct = DirectShading::stored;
};

void frames(benchmark::State& state, const Measured& m, const Camera& camera, const View& view) {
    Monitor silent;
    const Workers workers(threads);
    RenderOptions options;
    options.width = options.height = size;
    options.samples = view.samples;
    options.iterations = view.iterations;
    options.direct = view.direct;
    options.monte_carlo = view.monte_carlo ? MonteCarloShading::rays : MonteCarloShading::off;
    SolutionRenderer renderer(m.solution, options, workers, silent);
    for (auto _ : state) benchmark::DoNotOptimize(renderer.render(camera, workers, silent));
    state.counters["frames/s"] =
        benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void prepare(benchmark::State& state, const Measured& m) {
    Monitor silent;
    const Workers workers(threads);
    RenderOptions options;
    options.direct = DirectShading::stored;
    for (auto _ : state)
        benchmark::DoNotOptimize(SolutionRenderer(m.solution, options, workers, silent));
}

}  // namespace

int main(int count, char** words) {
    benchmark::Initialize(&count, words);
    std::vector<Measured> solutions;
    for (int i = 1; i < count; ++i) solutions.push_back({words[i], load_solution(words[i])});
    if (solutions.empty()) solutions.push_back(cornell_box());
    const std::vector<View> views{
        {"one_sample", 1, false, 1},
        {"adaptive", 16, false, 1},
        {"monte_carlo", 1, true, 1},
        {"traced", 16, false, 1, DirectShading::traced},
        {"traced_everywhere", 16, false, 1, DirectShading::traced_everywhere}};
    for (const Measured& m : solutions) {
        benchmark::RegisterBenchmark((m.name + "/prepare").c_str(),
                                     [&m](benchmark::State& s) { prepare(s, m); })
            ->MeasureProcessCPUTime()
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
        for (const Camera& camera : m.solution.cameras)
            for (const View& view : views)
                benchmark::RegisterBenchmark(
                    (m.name + "/" + camera.name + "/" + view.name).c_str(),
                    [&](benchmark::State& s) { frames(s, m, camera, view); })
                    ->MeasureProcessCPUTime()
                    ->UseRealTime()
                    ->Unit(benchmark::kMillisecond);
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
