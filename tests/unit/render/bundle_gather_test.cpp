// The Monte-Carlo component of new bundles in pictures: nothing where light is uniform, closed
// forms where elements are too coarse for them, and what is carried from picture to picture.
#include "support/closed_forms.h"
#include "support/scene_builder.h"
#include "unit/render/dark_solution.h"
#include "unit/render/surface_builder.h"

#include <transillum/render/render_solution.h>
#include <transillum/solution/bake.h>
#include <transillum/solution/patch_sources.h>
#include <transillum/transport/bundle_light.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

namespace transillum {
namespace {

using testing_support::dark_solution;
using testing_support::Facing;
using testing_support::glossy;
using testing_support::polygon_irradiance;
using testing_support::SceneBuilder;

constexpr float pi = std::numbers::pi_v<float>;
using enum MonteCarloShading;

/// Elements that hold a radiance of 1 from everywhere.
Solution uniformly_lit(const SurfaceMesh& surface, int level) {
    Solution s = dark_solution(surface, level);
    s.glossy_elements.assign(s.glossy.element_count, Spectrum(1.0f));
    s.indirect_irradiance.assign(s.patches.patch_count(), Spectrum(pi));
    return s;
}

Camera camera_at(const glm::dvec3& eye, const glm::dvec3& at, double fov = 60.0) {
    Camera c;
    c.eye = eye;
    c.look_at = at;
    c.up = {0.123, 0.456, 0.789};
    c.vertical_fov = fov;
    return c;
}

RenderOptions gathering(MonteCarloShading how, int bundles, int size = 16) {
    RenderOptions options;
    options.monte_carlo = how;
    options.iterations = bundles;
    options.width = options.height = size;
    return options;
}

Image picture(const Solution& s, const Camera& camera, const RenderOptions& options,
              int threads = 2) {
    Monitor silent;
    return render_solution(s, camera, options, Workers(threads), silent);
}

double largest_difference(const Image& a, const Image& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        largest = std::max(largest, double{max_channel(glm::abs(a.pixels[i] - b.pixels[i]))});
    return largest;
}

/// Of both representations.
class Gather : public testing::TestWithParam<MonteCarloShading> {};
INSTANTIATE_TEST_SUITE_P(Representations, Gather, testing::Values(subpatch, wavefront),
                         [](const auto& p) {
                             return p.param == subpatch ? "Subpatch" : "Wavefront";
                         });

class GatherInFurnace : public testing::TestWithParam<std::tuple<MonteCarloShading, Material>> {};
INSTANTIATE_TEST_SUITE_P(Lobes, GatherInFurnace,
                         testing::Combine(testing::Values(subpatch, wavefront),
                                          testing::Values(glossy(Lobe::none, 0.7f, 0.0f, 1, 1),
                                                          glossy(Lobe::max_phong, 0.3f, 0.5f, 3, 1),
                                                          glossy(Lobe::max_phong, 0.0f, 0.9f, 10,
                                                                 1),
                                                          glossy(Lobe::ggx, 0.5f, 0.04f, 0, 0.6f),
                                                          glossy(Lobe::ggx, 0.3f, 0.6f, 0, 0.5f))));

/// Radiance is sent in steps of 2^-20 of the brightest and more, and sums are of some dozens of
/// floats: within 1e-5 there is nothing to add, however few the bundles.
TEST_P(GatherInFurnace, UniformLightLeavesNothing) {
    const auto& [how, material] = GetParam();
    SceneBuilder b;
    b.scene.materials[0] = material;
    b.box({-1, -1, -1}, {1, 1, 1}, Facing::outwards);
    Solution s = uniformly_lit(b.surface(), 2);
    s.lighting.environment.kind = Environment::Kind::uniform;
    s.lighting.environment.radiance_scale = Spectrum(1.0f);
    const Camera camera = camera_at({3, 2, 1}, {0, 0, 0}, 40.0);
    EXPECT_LT(largest_difference(picture(s, camera, gathering(how, 5)),
                                 picture(s, camera, gathering(off, 5))),
              1e-5);
}

TEST_P(Gather, LeavesNothingInAClosedFurnace) {
    SceneBuilder b;
    b.scene.materials[0].diffuse = Spectrum(0.75f);
    b.scene.materials[0].emission = Spectrum(0.25f);
    b.box({0, 0, 0}, {1, 1.5, 0.7}, Facing::inwards);
    const Solution s = uniformly_lit(b.surface(), 3);
    const Camera camera = camera_at({0.2, 0.3, 0.2}, {0.8, 1.2, 0.4}, 90.0);
    for (const Spectrum& p : picture(s, camera, gathering(GetParam(), 7)).pixels)
        for (int c = 0; c < channel_count; ++c) EXPECT_NEAR(p[c], 1.0f, 1e-5f);
}

/// A luminous square of its own channels at z = 1 above black and white floors.
void add_panel(SceneBuilder& b, double low_x, double high_x, Spectrum radiance) {
    b.polygon({{low_x, -1, 1}, {low_x, 1, 1}, {high_x, 1, 1}, {high_x, -1, 1}},
              b.material(Spectrum(0.0f), radiance));
}

/// \param first green of the panel above x < 0, the other is red, and blue is both.
Solution under_panels(float first, std::uint32_t leaves) {
    SceneBuilder b;
    add_panel(b, -1, 0, Spectrum(0.0f, first, first));
    add_panel(b, 0, 1, Spectrum(1.0f, 0.0f, 1.0f));
    b.polygon({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, b.material(Spectrum(1.0f)));
    BakeOptions options;
    options.light.first_shot = FirstShot::off;
    options.subdivision.leaf_target = leaves;
    options.iteration.iterations = 1024;
    Monitor silent;
    return bake(b.scene, options, Workers(), silent);
}

/// Root of the mean square of the relative error over the floor.
double error_under_panels(const Solution& s, MonteCarloShading how, int bundles) {
    const std::vector<glm::dvec3> panel{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
    // From below the panels, straight down: pixels are squares of the floor.
    constexpr int size = 24;
    RenderOptions options = gathering(how, bundles, size);
    options.seed = 3;
    Camera camera = camera_at({0, 0, 0.99}, {0, 0, 0}, 90.0);
    camera.up = {0, 1, 0};
    const Image image = picture(s, camera, options);
    double squares = 0.0, mean = 0.0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double step = 2.0 * 0.99 / size;
            const glm::dvec3 at((x + 0.5) * step - 0.99, 0.99 - (y + 0.5) * step, 0.0);
            const double exact = polygon_irradiance(panel, at, {0, 0, 1}) / std::numbers::pi;
            const double e = image.at(x, y).z - exact;
            squares += e * e;
            mean += exact;
        }
    constexpr double count = size * size;
    return std::sqrt(squares / count) / (mean / count);
}

/// The floor's few patches miss the panel's gradient; bundles find it, as deep buffers know them to
/// within their own noise, on quarters as far as these resolve it.
TEST(GatherUnderPanels, TendsToTheClosedForm) {
    const Solution s = under_panels(1.0f, 24);
    const double plain = error_under_panels(s, off, 1);
    const double quarters = error_under_panels(s, subpatch, 1024);
    const double few = error_under_panels(s, wavefront, 64);
    const double many = error_under_panels(s, wavefront, 1024);
    EXPECT_LT(quarters, 0.5 * plain);
    EXPECT_LT(many, 0.5 * few);
    EXPECT_LT(many, 0.1 * plain);
}

/// Interpolation trusts gradients as far as they explain a field, which is not linear: without it.
TEST_P(Gather, AddsAndScalesLight) {
    Solution s = under_panels(1.0f, 24), twice = under_panels(2.0f, 24);
    for (std::size_t p = 0; p < s.indirect_irradiance.size(); ++p) {
        Spectrum& e = s.indirect_irradiance[p];
        e.z = e.x + e.y;
        twice.indirect_irradiance[p] = {e.x, 2.0f * e.y, e.x + 2.0f * e.y};
    }
    const Camera camera = camera_at({0, 0, 0.9}, {0.3, 0.1, 0}, 80.0);
    RenderOptions options = gathering(GetParam(), 16);
    options.interpolate = false;
    const Image a = picture(s, camera, options), b = picture(twice, camera, options);
    int compared = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        // What would be below 0 is cut off.
        if (!(a.pixels[i].x > 0.0f && a.pixels[i].y > 0.0f)) continue;
        ++compared;
        EXPECT_NEAR(a.pixels[i].x + a.pixels[i].y, a.pixels[i].z, 2e-5f);
        EXPECT_NEAR(b.pixels[i].y, 2.0f * a.pixels[i].y, 2e-5f);
        EXPECT_NEAR(b.pixels[i].x, a.pixels[i].x, 2e-5f);
    }
    EXPECT_GT(compared, 200);
}

/// A lamp over a glossy block in a Lambert room.
Solution glossy_block() {
    SceneBuilder b;
    b.scene.materials[0].diffuse = Spectrum(0.7f, 0.5f, 0.3f);
    const auto lamp = b.material(Spectrum(0.0f), Spectrum(2.0f));
    b.scene.materials.push_back(glossy(Lobe::max_phong, 0.2f, 0.6f, 10, 1));
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    b.polygon({{0.3, 0.3, 0.99}, {0.3, 0.7, 0.99}, {0.7, 0.7, 0.99}, {0.7, 0.3, 0.99}}, lamp);
    b.box({0.3, 0.3, 0.0}, {0.7, 0.7, 0.4}, Facing::outwards, 2);
    BakeOptions options;
    options.subdivision.leaf_target = 500;
    options.iteration.iterations = 64;
    options.light.first_shot = FirstShot::off;
    Monitor silent;
    return bake(b.scene, options, Workers(), silent);
}
const Camera in_the_room = camera_at({0.1, 0.12, 0.8}, {0.6, 0.6, 0.2}, 70.0);

TEST_P(Gather, DoesNotDependOnTheNumberOfThreads) {
    const Solution s = glossy_block();
    const RenderOptions options = gathering(GetParam(), 8);
    EXPECT_EQ(picture(s, in_the_room, options, 1).pixels,
              picture(s, in_the_room, options, 3).pixels);
}

TEST_P(Gather, AddsToWhatIsShownWithout) {
    const Solution s = glossy_block();
    RenderOptions alone = gathering(GetParam(), 8), rest = gathering(off, 8);
    alone.components = {false, false, false, true};
    const Image whole = picture(s, in_the_room, gathering(GetParam(), 8));
    const Image residual = picture(s, in_the_room, alone), others = picture(s, in_the_room, rest);
    int brighter = 0, darker = 0;
    for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
        const float change = whole.pixels[i].x - others.pixels[i].x;
        // Alone, what is below 0 is left out.
        EXPECT_NEAR(residual.pixels[i].x, std::max(0.0f, change), 1e-5f);
        brighter += change > 1e-4f;
        darker += change < -1e-4f;
    }
    EXPECT_GT(brighter, 10);
    EXPECT_GT(darker, 10);
}

TEST_P(Gather, DarknessStaysDark) {
    SceneBuilder b;
    b.scene.materials[0].diffuse = Spectrum(0.5f);
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
    Solution s = uniformly_lit(b.surface(), 1);
    std::ranges::fill(s.indirect_irradiance, Spectrum(0.0f));
    for (const Spectrum& p : picture(s, in_the_room, gathering(GetParam(), 4)).pixels)
        EXPECT_EQ(p, Spectrum(0.0f));
}

/// Patches smaller than a pixel, most of them between pixels' centres along most bundles: what they
/// are told to receive is what arrives at points on them. The floor emits, so that directions
/// differ.
TEST_P(Gather, SmallPatchesReceiveWhatTheirPointsDo) {
    SceneBuilder b;
    const auto lamp = b.material(Spectrum(0.0f), Spectrum(1.0f));
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, 0, 0);
    b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, lamp);
    Solution s = uniformly_lit(b.surface(), 6);
    const PatchSources sources = make_sources(s);
    const Workers workers(2);
    BundleLight light(
        s.surface, s.patches, sources, s.indirect_irradiance, s.glossy_elements,
        {GetParam() == subpatch ? MonteCarlo::subpatch : MonteCarlo::wavefront, 0.03, 1}, workers);
    double at_points = 0.0, of_patches = 0.0;
    for (int i = 0; i < 32; ++i) {
        light.next();
        for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; leaf += 7) {
            const std::uint32_t root = s.patches.root_of_leaf[leaf];
            const auto [corners, level] = leaf_corners(s.patches, leaf);
            const glm::vec2 at = glm::vec2(corners[0] + corners[1] + corners[2]) /
                                 (3.0f * static_cast<float>(1 << level));
            const double cosine = std::abs(glm::dot(normal_of(s.surface, root), light.direction()));
            at_points +=
                cosine *
                light.incoming({root, false, at.x, at.y, leaf_centre(s.surface, s.patches, leaf)})
                    .x;
            of_patches += cosine * light.mean_incoming(leaf).x;
        }
    }
    EXPECT_NEAR(at_points, of_patches, 5e-3 * of_patches);
}

class CarriedResidual : public testing::Test {
protected:
    /// The last of pictures one after the other.
    static Image last_of(const Solution& s, const std::vector<Camera>& cameras, int bundles,
                         std::uint64_t seed = 1) {
        const Workers workers(2);
        Monitor silent;
        RenderOptions options = gathering(subpatch, bundles);
        options.seed = seed;
        SolutionRenderer renderer(s, options, workers, silent);
        Image image;
        for (const Camera& c : cameras) image = renderer.render(c, workers, silent);
        return image;
    }
};

TEST_F(CarriedResidual, AStillEyeGoesOnAveraging) {
    const Solution s = glossy_block();
    const Image once = last_of(s, {in_the_room}, 32);
    const Image in_steps = last_of(s, std::vector<Camera>(4, in_the_room), 8);
    EXPECT_LT(largest_difference(once, in_steps), 2e-5);
    EXPECT_GT(largest_difference(once, last_of(s, {in_the_room}, 8)), 1e-3);
}

TEST_F(CarriedResidual, OfLambertSurfacesDependsOnNoEye) {
    const Solution s = under_panels(1.0f, 24);
    const Camera here = camera_at({0.3, 0.2, 0.9}, {0, 0, 0}, 80.0);
    const Camera elsewhere = camera_at({-1.5, 1.5, 0.5}, {-1, 1, 0}, 30.0);
    EXPECT_LT(largest_difference(last_of(s, {here}, 16), last_of(s, {elsewhere, here}, 8)), 2e-5);
}

/// A few bundles bring mostly noise, of which next to nothing is shown.
TEST_F(CarriedResidual, StartsFromPlainFiniteElements) {
    const Solution s = glossy_block();
    const Image plain = picture(s, in_the_room, gathering(off, 1));
    const Image exact = picture(s, in_the_room, gathering(subpatch, 512));
    const double error = compare_images(plain, exact).relative_rmse;
    // One bundle more or less, in the mean: some of them meet what is bright.
    constexpr int seeds = 16;
    double squares = 0.0;
    for (int seed = 1; seed <= seeds; ++seed)
        squares +=
            std::pow(compare_images(last_of(s, {in_the_room}, 1, seed), exact).relative_rmse, 2.0);
    EXPECT_LT(std::sqrt(squares / seeds), 1.1 * error);
    EXPECT_LT(compare_images(last_of(s, {in_the_room}, 128), exact).relative_rmse, 0.5 * error);
}

/// The same bundles seen before from nearby tell nearly as much as seen from here; from across, a
/// lobe's part in them is forgotten.
TEST_F(CarriedResidual, OfALobeIsForgottenAsTheEyeTurns) {
    const Solution s = glossy_block();
    const Camera nearby = camera_at({0.105, 0.125, 0.8}, {0.6, 0.6, 0.2}, 70.0);
    const Camera across = camera_at({0.9, 0.88, 0.8}, {0.4, 0.4, 0.2}, 70.0);
    const Image stayed = last_of(s, {in_the_room, in_the_room}, 16);
    const double from_nearby = largest_difference(last_of(s, {nearby, in_the_room}, 16), stayed);
    const double from_across = largest_difference(last_of(s, {across, in_the_room}, 16), stayed);
    EXPECT_LT(from_nearby, 0.25 * from_across);
}

}  // namespace
}  // namespace transillum
