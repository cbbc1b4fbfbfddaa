// A closed box whose walls emit what they do not reflect: the radiance is 1 everywhere, in every
// direction.
#include <transillum/base/error.h>
#include <transillum/render/render_solution.h>
#include <transillum/solution/bake.h>

#include <array>
#include <cmath>
#include <cstdio>

namespace {

constexpr float albedo = 0.7f;

transillum::Scene make_furnace() {
    transillum::Scene scene;
    scene.path = "furnace";
    for (int i = 0; i < 8; ++i) scene.positions.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    // Corners turn counter-clockwise as seen from inside.
    constexpr std::array<std::array<unsigned, 4>, 6> walls{
        {{0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
    for (const auto& wall : walls) {
        transillum::Polygon polygon;
        polygon.first_corner = static_cast<unsigned>(scene.corners.size());
        polygon.corner_count = 4;
        scene.polygons.push_back(polygon);
        scene.corners.insert(scene.corners.end(), wall.begin(), wall.end());
    }
    transillum::Material material;
    material.diffuse = transillum::Spectrum(albedo);
    material.emission = transillum::Spectrum(1.0f - albedo);
    scene.materials.push_back(material);
    scene.objects.emplace_back("walls");
    return scene;
}

}  // namespace

int main() try {
    transillum::BakeOptions options;
    options.subdivision.leaf_target = 200;
    options.iteration.iterations = 256;
    transillum::Monitor silent;
    const transillum::Workers workers;
    const transillum::Solution solution =
        transillum::bake(make_furnace(), options, workers, silent);

    transillum::Camera camera;
    camera.eye = {0.3, 0.4, 0.5};
    camera.look_at = {1.0, 0.0, 0.0};
    transillum::RenderOptions render;
    render.width = render.height = 16;
    const transillum::Image image =
        transillum::render_solution(solution, camera, render, workers, silent);
    double largest = 0.0;
    for (const transillum::Spectrum& pixel : image.pixels)
        for (int c = 0; c < transillum::channel_count; ++c)
            largest = std::fmax(largest, std::abs(pixel[c] - 1.0));
    std::printf("largest deviation from 1: %g\n", largest);
    // A few roundings in single precision.
    return largest < 1e-6 ? 0 : 1;
} catch (const transillum::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
