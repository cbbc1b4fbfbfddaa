// Pictures in bands of wavelengths.
#include "support/metamers.h"
#include "support/scene_builder.h"

#include <transillum/render/render_bands.h>
#include <transillum/solution/bake_bands.h>

#include <gtest/gtest.h>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

const Camera camera{"inside", {0.5, 0.1, 0.4}, {0.5, 1.4, 0.2}, {0, 0, 1}, 70.0};

/// A closed grey room with a small lamp.
Scene room(float diffuse = 0.5f) {
    SceneBuilder b;
    b.scene.materials[0].name = "wall";
    b.scene.materials[0].diffuse = Spectrum(diffuse);
    b.box({0, 0, 0}, {1, 1.5, 0.7}, Facing::inwards);
    const std::uint32_t lamp = b.material(Spectrum(0.0f), Spectrum(20.0f));
    b.polygon({{0.4, 0.6, 0.69}, {0.4, 0.8, 0.69}, {0.6, 0.8, 0.69}, {0.6, 0.6, 0.69}}, lamp);
    return b.scene;
}

BakeOptions coarse() {
    BakeOptions options;
    options.subdivision.leaf_target = 400;
    options.iteration.iterations = 128;
    options.resolution = 128;
    options.hemicube_resolution = 64;
    return options;
}

RenderOptions small() {
    RenderOptions options;
    options.width = 24;
    options.height = 18;
    options.samples = 4;
    return options;
}

SpectralSolution bake_it(const Scene& scene, const SpectralOptions& spectral) {
    Monitor silent;
    return bake_bands(scene, spectral, coarse(), Workers(2), silent);
}

Image picture(const SpectralSolution& s, const RenderOptions& options = small()) {
    Monitor silent;
    return render_bands(s, camera, options, Workers(2), silent);
}

/// Of the pixels that see no emitter, relative to the brightest of them.
double largest_difference(const Image& a, const Image& b) {
    double most = 0.0, brightest = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        if (a.emitter_mask[i] > 0.0f) continue;
        most = std::max<double>(most, max_channel(glm::abs(a.pixels[i] - b.pixels[i])));
        brightest = std::max<double>(brightest, max_channel(a.pixels[i]));
    }
    return most / brightest;
}

TEST(RenderBands, OfAGreySceneAreAsRgb) {
    const Scene scene = room();
    Monitor silent;
    const SpectralSolution rgb{bake(scene, coarse(), Workers(2), silent), 0, {}};
    const Image a = picture(rgb), b = picture(bake_it(scene, {}));
    EXPECT_EQ(a.emitter_mask, b.emitter_mask);
    EXPECT_LT(largest_difference(a, b), 1e-5);
}

// The same colour under white light; other colours once walls light walls.
TEST(RenderBands, ShowMetamersAlikeUntilTheyReflectEachOther) {
    const auto [flat, bumpy] = grey_metamers(Bands(12));
    const SpectralSolution a = bake_it(room(), {12, {{"wall", flat, {}, {}, {}}}, 0.99f}),
                           b = bake_it(room(), {12, {{"wall", bumpy, {}, {}, {}}}, 0.99f});
    for (const DirectShading shading : {DirectShading::stored, DirectShading::traced}) {
        RenderOptions options = small();
        options.direct = shading;
        options.components = {.emission = true, .direct = true, .finite_element = false};
        EXPECT_LT(largest_difference(picture(a, options), picture(b, options)), 1e-5);
        options.components.finite_element = true;
        EXPECT_GT(largest_difference(picture(a, options), picture(b, options)), 0.02);
    }
}

TEST(RenderBands, OfAPathAreThoseOfASinglePicture) {
    const SpectralSolution s = bake_it(room(0.7f), {8, {}, 0.99f});
    Monitor silent;
    const Workers two(2);
    BandRenderer renderer(s, small(), two, silent);
    const Image a = picture(s), b = renderer.render(camera, Workers(1), silent);
    EXPECT_EQ(a.pixels, b.pixels);
    EXPECT_EQ(a.emitter_mask, b.emitter_mask);
    const SpectralSolution rgb{s.rgb, 0, {}};
    EXPECT_EQ(
        BandRenderer(rgb, small(), Workers(2), silent).render(camera, Workers(2), silent).pixels,
        picture(rgb).pixels);
}

// Against paths of light in the same bands: mean colours, of which the paths' noise is below 1 %,
// and the patches' size hides some of the light next to edges.
TEST(RenderBands, AgreeWithPathTracing) {
    const Scene scene = room();
    const auto [flat, bumpy] = grey_metamers(Bands(12));
    const SpectralOptions spectral{12, {{"wall", bumpy, {}, {}, {}}}, 0.99f};
    Monitor silent;
    PathTraceOptions paths;
    paths.width = small().width;
    paths.height = small().height;
    paths.samples = 256;
    const Image traced = path_trace_bands(build_surface(scene, {}, silent), scene, spectral, camera,
                                          paths, Workers(2), silent);
    const Image baked = picture(bake_it(scene, spectral));
    SpectrumSum a(0.0), b(0.0);
    for (std::size_t i = 0; i < traced.pixels.size(); ++i) {
        if (traced.emitter_mask[i] > 0.0f || baked.emitter_mask[i] > 0.0f) continue;
        a += SpectrumSum(baked.pixels[i]);
        b += SpectrumSum(traced.pixels[i]);
    }
    for (int c = 0; c < channel_count; ++c) EXPECT_NEAR(a[c] / b[c], 1.0, 0.03) << c;
}

}  // namespace
