// Real scenes, dirt and all: each must load, bake and look as bright as an independent renderer
// (Cycles) found it.
#include <transillum/render/path_trace.h>
#include <transillum/render/render_solution.h>
#include <transillum/scene/limit_albedo.h>
#include <transillum/scene/load_scene.h>
#include <transillum/solution/bake.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace {

using namespace transillum;

struct RealScene {
    const char* path;
    Camera camera;
    /// Radiance in a small Cycles picture from there; 0 where metals make it another picture than a
    /// diffuse one, and the path tracer says instead.
    double median;
    Sides sides = Sides::file;
};

void PrintTo(const RealScene& s, std::ostream* out) {
    *out << s.path;
}

Camera view(glm::dvec3 eye, glm::dvec3 look_at, glm::dvec3 up, double fov) {
    return {"", eye, look_at, up, fov};
}

const glm::dvec3 y_up(0, 1, 0), z_up(0, 0, 1);

class RealDataScene : public testing::TestWithParam<RealScene> {
protected:
    const std::filesystem::path folder = std::filesystem::path(TRANSILLUM_TEST_DATA) / "scenes";
};

double median_luminance(const Image& image) {
    std::vector<double> all;
    for (const Spectrum& p : image.pixels) all.push_back(luminance(p));
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
}

TEST_P(RealDataScene, BakesAndLooksAsBrightAsItShould) {
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no test data at " << folder;
    const RealScene& real = GetParam();
    Monitor silent;
    LoadOptions load;
    load.sides = real.sides;
    Scene scene = load_scene(folder / real.path, load, silent);
    limit_albedo(scene, 0.99f, silent);
    BakeOptions options;
    options.iteration.iterations = 64;
    options.light.samples = 4;
    options.hemicube_resolution = 256;
    const Workers workers(2);
    const Solution solution = bake(scene, options, workers, silent);

    // What is emitted is absorbed or leaves, but for the estimate's error.
    const double emitted = luminance(solution.balance.emitted);
    const double gone = luminance(solution.balance.absorbed + solution.balance.escaped +
                                  solution.balance.black_backs);
    EXPECT_NEAR(gone / emitted, 1.0, 0.1);

    RenderOptions render;
    render.width = 96;
    render.height = 72;
    render.samples = 4;
    render.direct = DirectShading::stored;
    const Image image = render_solution(solution, real.camera, render, workers, silent);
    const double median = median_luminance(image);
    double expected = real.median;
    if (expected == 0.0) {
        PathTraceOptions paths;
        paths.width = render.width;
        paths.height = render.height;
        paths.samples = 64;
        expected =
            median_luminance(path_trace(solution.surface, {}, real.camera, paths, workers, silent));
    }
    RecordProperty("median", std::to_string(median));
    EXPECT_GT(median / expected, 0.5) << median;
    EXPECT_LT(median / expected, 2.0) << median;
}

INSTANTIATE_TEST_SUITE_P(
    Rooms, RealDataScene,
    testing::Values(
        RealScene{"cornell-mcguire/CornellBox-Original.obj",
                  view({0, 0.99, 3.88}, {0, 0.99, 0}, y_up, 39.3), 0.05},
        RealScene{"cornell-nvidia/cornellBox.gltf", view({0, 0, 19.99}, {0, 0, 0}, y_up, 41.11),
                  0.0, Sides::one},
        RealScene{"hospital/hospital.obj", view({3.4, 6.6, 1.7}, {5.2, 2.6, 0.7}, z_up, 65), 0.1},
        RealScene{"hospital/hospital.obj", view({1.3, 12.2, 1.6}, {2, 2, 1}, z_up, 60), 0.03},
        RealScene{"classroom-mgf/classroom-mgf.obj",
                  view({3.2, 10.8, 2.2}, {4.5, 2.9, 0.15}, z_up, 60), 0.005},
        RealScene{"office3/office3.obj", view({2.1, 3.3, -0.4}, {-2, 1.9, 1.4}, y_up, 60), 0.18},
        RealScene{"kitchen-lux/kitchen-lux.obj",
                  view({7.634, -4.168, 1.422}, {12.037, 4.713, 0.107}, z_up, 90), 0.15}));

}  // namespace
