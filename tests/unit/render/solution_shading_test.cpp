// What solutions with glossy sides, skies and textures look like: closed forms, and the path
// tracer.
#include "support/closed_forms.h"
#include "support/scene_builder.h"
#include "unit/render/dark_solution.h"
#include "unit/render/surface_builder.h"

#include <transillum/render/path_trace.h>
#include <transillum/render/render_solution.h>
#include <transillum/scene/brdf.h>
#include <transillum/solution/bake.h>

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace transillum {
namespace {

using testing_support::dark_solution;
using testing_support::Estimate;
using testing_support::estimate;
using testing_support::Facing;
using testing_support::glossy;
using testing_support::Recorder;
using testing_support::SceneBuilder;
using testing_support::SurfaceBuilder;

constexpr float pi = std::numbers::pi_v<float>;

Material mirror() {
    return glossy(Lobe::ggx, 0.0f, 1.0f, 0.0f, 0.0f);
}

constexpr std::array<glm::dvec3, 4> floor_square{{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}};

SurfaceMesh floor_of(const Material& material) {
    SurfaceBuilder builder;
    const auto m = builder.material(Spectrum(0.0f));
    builder[m] = material;
    builder.quad(floor_square, m, 0);
    return builder.build();
}

Camera narrow_camera(const glm::dvec3& eye, const glm::dvec3& at) {
    Camera camera;
    camera.eye = eye;
    camera.look_at = at;
    camera.up = {0.123, 0.456, 0.789};
    camera.vertical_fov = 1e-4;
    return camera;
}

struct Seen {
    Spectrum radiance;
    float emitter;
};
Seen seen(const Solution& s, const glm::dvec3& eye, const glm::dvec3& at,
          RenderOptions options = {}) {
    Monitor silent;
    options.width = options.height = 1;
    const Image image = render_solution(s, narrow_camera(eye, at), options, Workers(1), silent);
    return {image.at(0, 0), image.emitter_mask[0]};
}

void light_from_everywhere(Solution& s, float radiance) {
    s.lighting.environment.kind = Environment::Kind::uniform;
    s.lighting.environment.radiance_scale = Spectrum(radiance);
    std::ranges::fill(s.glossy_elements, Spectrum(radiance));
    std::ranges::fill(s.indirect_irradiance, Spectrum(radiance * pi));
}

RenderOptions with_monte_carlo(bool on) {
    RenderOptions options;
    options.monte_carlo = on ? MonteCarloShading::rays : MonteCarloShading::off;
    return options;
}

TEST(Background, IsTheEnvironment) {
    Solution s = dark_solution(floor_of(glossy(Lobe::none, 0.5f, 0, 0, 1)), 0);
    s.lighting.environment.kind = Environment::Kind::uniform;
    s.lighting.environment.radiance_scale = {1.0f, 2.0f, 3.0f};
    const Seen sky = seen(s, {0, 0, 1}, {0, 0, 2});
    EXPECT_EQ(sky.radiance, Spectrum(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(sky.emitter, 1.0f);
    RenderOptions unlit;
    unlit.components.emission = false;
    EXPECT_EQ(seen(s, {0, 0, 1}, {0, 0, 2}, unlit).radiance, Spectrum(0.0f));
}

class ConvexFurnace : public testing::TestWithParam<Material> {};

INSTANTIATE_TEST_SUITE_P(Lobes, ConvexFurnace,
                         testing::Values(glossy(Lobe::max_phong, 0.3f, 0.5f, 3, 1),
                                         glossy(Lobe::max_phong, 0.0f, 0.9f, 10, 1),
                                         glossy(Lobe::max_phong, 0.1f, 0.8f, 35, 1),
                                         glossy(Lobe::ggx, 0.5f, 0.04f, 0, 0.6f),
                                         glossy(Lobe::ggx, 0.0f, 0.9f, 0, 0.5f)));

/// A convex body in a uniform sky: both finite elements and rays find the radiance 1 from
/// everywhere.
TEST_P(ConvexFurnace, ShowsTheDirectionalAlbedoAtEveryPixel) {
    SceneBuilder builder;
    builder.scene.materials[0] = GetParam();
    builder.box({-1, -1, -1}, {1, 1, 1}, Facing::outwards);
    Solution s = dark_solution(builder.surface(), 2);
    light_from_everywhere(s, 1.0f);
    const Brdf brdf = brdf_of(GetParam());
    const glm::dvec3 eye(5, 3, 2);
    for (const bool monte_carlo : {false, true})
        for (double u = -0.9; u < 1.0; u += 0.3)
            for (double v = -0.95; v < 1.0; v += 0.3)
                for (int axis = 0; axis < 3; ++axis) {
                    glm::dvec3 at(0.0);
                    at[axis] = 1.0;
                    at[(axis + 1) % 3] = u;
                    at[(axis + 2) % 3] = v;
                    const glm::dvec3 out = glm::normalize(eye - at);
                    const Spectrum albedo = directional_albedo(brdf, static_cast<float>(out[axis]));
                    EXPECT_NEAR(seen(s, eye, at, with_monte_carlo(monte_carlo)).radiance.x,
                                albedo.x, 2e-5f)
                        << u << ", " << v << ", axis " << axis;
                }
}

/// Lobes that rays follow: within five standard errors and the albedo table's error.
TEST(SharpLobes, HaveTheirAlbedoInTheMean) {
    for (const Material& m :
         {glossy(Lobe::max_phong, 0.1f, 0.8f, 200, 1), glossy(Lobe::ggx, 0.2f, 0.6f, 0, 0.1f)}) {
        Solution s = dark_solution(floor_of(m), 2);
        light_from_everywhere(s, 1.0f);
        ASSERT_TRUE(is_sharper_than_bins(brdf_of(m)));
        const glm::dvec3 eye(1.6, 0.3, 1.1);
        std::vector<double> values;
        for (std::uint64_t seed = 1; seed <= 16; ++seed) {
            RenderOptions options;
            options.seed = seed;
            values.push_back(seen(s, eye, {0, 0, 0}, options).radiance.x);
        }
        const Estimate e = estimate(values);
        const double albedo =
            directional_albedo(brdf_of(m), static_cast<float>(glm::normalize(eye).z)).x;
        EXPECT_LT(e.error, 0.01);
        EXPECT_NEAR(e.mean, albedo, 5.0 * e.error + 1e-3);
    }
}

void add_texture(SurfaceMesh& mesh, std::int32_t MaterialTextures::*which,
                 std::vector<Spectrum> texels, int width) {
    for (const RootTriangle& t : mesh.triangles)
        for (const std::uint32_t vertex : t.vertices)
            mesh.uvs.emplace_back(0.25 * (mesh.positions[vertex].x + 2.0),
                                  0.25 * (mesh.positions[vertex].y + 2.0));
    auto texture = std::make_shared<Texture>();
    texture->width = width;
    texture->height = static_cast<int>(texels.size()) / width;
    texture->texels = std::move(texels);
    mesh.textures.push_back(texture);
    mesh.materials[0].textures.*which = 0;
}

/// Two patches, and 8 x 8 texels on them.
TEST(Textures, AreSeenTexelByTexel) {
    std::vector<Spectrum> texels;
    for (int i = 0; i < 64; ++i)
        texels.emplace_back(0.01f * static_cast<float>(i), 0.5f,
                            0.9f - 0.01f * static_cast<float>(i));
    for (const bool emits : {false, true}) {
        SurfaceMesh mesh = floor_of(glossy(Lobe::none, 0.5f, 0, 0, 1));
        add_texture(mesh, emits ? &MaterialTextures::emission : &MaterialTextures::diffuse, texels,
                    8);
        if (emits) {
            mesh.materials[0].diffuse = Spectrum(0.0f);
            mesh.materials[0].emission = Spectrum(0.5f);
        }
        Solution s = dark_solution(mesh, 0);
        light_from_everywhere(s, 1.0f);
        for (double x = -1.75; x < 2.0; x += 0.5)
            for (double y = -1.75; y < 2.0; y += 0.5) {
                const Spectrum expected =
                    mesh.textures[0]->at({0.25 * (x + 2.0), 0.25 * (y + 2.0)});
                const Spectrum here = seen(s, {0.1, 0.2, 3}, {x, y, 0}).radiance;
                for (int c = 0; c < channel_count; ++c)
                    EXPECT_NEAR(here[c], expected[c], 1e-4f) << x << ", " << y;
            }
    }
}

/// A point light, a spot and a sun above a floor, and one below it.
Lighting punctual_lights() {
    Lighting lighting;
    lighting.lights.resize(4);
    lighting.lights[0].position = {-1.0, 0.5, 1.5};
    lighting.lights[0].intensity = Spectrum(7.0f);
    lighting.lights[1].kind = PunctualLight::Kind::directional;
    lighting.lights[1].direction = glm::normalize(glm::dvec3(1.0, 0.2, -1.0));
    lighting.lights[1].intensity = Spectrum(2.0f);
    lighting.lights[2].kind = PunctualLight::Kind::spot;
    lighting.lights[2].position = {-1.5, -0.5, 2.0};
    lighting.lights[2].direction = glm::normalize(-lighting.lights[2].position);
    lighting.lights[2].intensity = Spectrum(4.0f);
    lighting.lights[3].position = {-1.0, 0.5, -1.5};
    return lighting;
}

double reflected_of(const Lighting& lighting, const Brdf& brdf, const glm::dvec3& out) {
    double sum = 0.0;
    for (const PunctualLight& l : lighting.lights) {
        const bool sun = l.kind == PunctualLight::Kind::directional;
        const glm::dvec3 in = sun ? -l.direction : glm::normalize(l.position);
        if (in.z < 0.0) continue;
        const double irradiance =
            sun ? double{l.intensity.x}
                : l.intensity_towards(-in).x / glm::dot(l.position, l.position);
        sum += irradiance * in.z * evaluate(brdf, in, out).x;
    }
    return sum;
}

class PunctualLightsOnSolutions : public testing::TestWithParam<Material> {};

INSTANTIATE_TEST_SUITE_P(Lobes, PunctualLightsOnSolutions,
                         testing::Values(glossy(Lobe::none, 0.6f, 0, 0, 1),
                                         glossy(Lobe::max_phong, 0.3f, 0.5f, 10, 1),
                                         glossy(Lobe::max_phong, 0.0f, 0.8f, 200, 1),
                                         glossy(Lobe::ggx, 0.5f, 0.04f, 0, 0.3f)));

TEST_P(PunctualLightsOnSolutions, ReflectTheirClosedForm) {
    Solution s = dark_solution(floor_of(GetParam()), 1);
    s.lighting = punctual_lights();
    s.direct.samples =
        sample_luminaires(s.surface, {.first_shot = FirstShot::off}, s.lighting.lights).samples;
    const std::size_t n = s.direct.samples.size();
    ASSERT_EQ(n, 4u);
    s.direct.geometry_factor.assign(n * s.patches.patch_count(), 1.0f);
    s.direct.visibility.assign(n * s.patches.patch_count(), 1.0f);
    const glm::dvec3 eye(1.6, 0.1, 1.2);
    const double exact = reflected_of(s.lighting, brdf_of(GetParam()), glm::normalize(eye));
    for (const DirectShading shading : {DirectShading::traced, DirectShading::stored})
        for (const bool interpolate : {false, true}) {
            if (shading == DirectShading::stored && s.glossy.empty()) continue;  // patch means
            RenderOptions options;
            options.components.emission = options.components.finite_element = false;
            options.direct = shading;
            options.interpolate = interpolate;
            EXPECT_NEAR(seen(s, eye, {0, 0, 0}, options).radiance.x, exact, 1e-4 * exact);
        }
}

/// On every patch as at the origin.
void turn_into_vectors(Solution& s) {
    DirectLight& direct = s.direct;
    direct.geometry_factor.clear();
    direct.visibility.clear();
    std::vector<glm::vec3> row;
    for (const LightSample& light : direct.samples) {
        direct.first_samples.push_back(static_cast<std::uint32_t>(row.size()));
        const Incident i = incident_light(light, s.lighting, {0, 0, 0});
        const double share = i.irradiance.x / light.emitted.x * std::max(0.0, i.direction.z);
        row.emplace_back(share * i.direction);
    }
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p)
        direct.vectors.insert(direct.vectors.end(), row.begin(), row.end());
}

TEST_P(PunctualLightsOnSolutions, ReflectTheirClosedFormFromLightVectors) {
    Solution s = dark_solution(floor_of(GetParam()), 1);
    if (s.glossy.empty()) return;  // shows irradiances
    s.lighting = punctual_lights();
    s.direct.samples =
        sample_luminaires(s.surface, {.first_shot = FirstShot::off}, s.lighting.lights).samples;
    turn_into_vectors(s);
    const glm::dvec3 eye(1.6, 0.1, 1.2);
    const double exact = reflected_of(s.lighting, brdf_of(GetParam()), glm::normalize(eye));
    for (const bool interpolate : {false, true}) {
        RenderOptions options;
        options.components.emission = options.components.finite_element = false;
        options.direct = DirectShading::stored;
        options.interpolate = interpolate;
        EXPECT_NEAR(seen(s, eye, {0, 0, 0}, options).radiance.x, exact, 1e-4 * exact);
    }
}

TEST(DirectLightOnSolutions, IsHiddenByWhatStandsBefore) {
    SurfaceBuilder builder;
    const auto m = builder.material(Spectrum(0.0f));
    builder[m] = glossy(Lobe::max_phong, 0.3f, 0.5f, 10, 1);
    builder.quad(floor_square, m, 0);
    builder.quad({{{-2, -2, 4}, {0, -2, 4}, {0, 2, 4}, {-2, 2, 4}}}, m, 1);
    Solution s = dark_solution(builder.build(), 0);
    s.lighting.lights.resize(1);
    PunctualLight& sun = s.lighting.lights[0];
    sun.kind = PunctualLight::Kind::directional;
    sun.direction = {0, 0, -1};
    s.direct.samples =
        sample_luminaires(s.surface, {.first_shot = FirstShot::off}, s.lighting.lights).samples;
    testing_support::leave_samples_in_doubt(s);
    EXPECT_EQ(seen(s, {0, 0, 1}, {-0.1, 0, 0}, with_monte_carlo(false)).radiance.x, 0.0f);
    EXPECT_GT(seen(s, {0, 0, 1}, {0.1, 0, 0}, with_monte_carlo(false)).radiance.x, 0.1f);
}

/// Walls with a shine of their own; with a mirror for the wall at x = 0, or without.
SurfaceMesh hall(bool mirrored) {
    SurfaceBuilder builder;
    const auto wall = builder.material(Spectrum(0.7f, 0.5f, 0.3f)),
               glass = builder.material(Spectrum(0.0f));
    builder[glass] = mirror();
    builder.room({0, 0, 0}, {3, 2, 1}, {wall, wall, wall, wall, glass, wall});
    SurfaceMesh mesh = builder.build();
    if (!mirrored)
        std::erase_if(mesh.triangles, [&](const RootTriangle& t) { return t.material == glass; });
    return mesh;
}

/// The mirror shows what an eye behind it would see, were it not there.
TEST(Mirror, ShowsTheMirroredRoom) {
    const auto lit = [](bool mirrored) {
        Solution s = dark_solution(hall(mirrored), 3);
        for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf) {
            const glm::dvec3 p = leaf_centre(s.surface, s.patches, leaf);
            s.indirect_irradiance[leaf] = Spectrum(static_cast<float>(2.0 + p.x - p.y + 2.0 * p.z));
        }
        return s;
    };
    const Solution with = lit(true), without = lit(false);
    const glm::dvec3 eye(1.2, 0.9, 0.55), flipped(-1, 1, 1);
    RenderOptions options;
    options.iterations = 64;
    int compared = 0;
    for (double y = 0.2; y < 1.9; y += 0.21)
        for (double z = 0.15; z < 0.9; z += 0.17) {
            const glm::dvec3 at(0, y, z);
            const Spectrum in_mirror = seen(with, eye, at, options).radiance;
            const Spectrum behind = seen(without, eye * flipped, at * flipped, options).radiance;
            // The finest lobe is a milliradian wide: 64 rays of it, 4 units long, over a slope of
            // 3, and its tail.
            for (int c = 0; c < channel_count; ++c)
                EXPECT_NEAR(in_mirror[c], behind[c], 5e-3f * behind[c]) << y << ", " << z;
            ++compared;
        }
    EXPECT_GT(compared, 30);
}

/// Emitters of the first shot are seen in it once: as themselves.
TEST(Mirror, ShowsLampsOnce) {
    SurfaceBuilder builder;
    const auto glass = builder.material(Spectrum(0.0f)),
               lamp = builder.material(Spectrum(0.0f), Spectrum(5.0f));
    builder[glass] = mirror();
    builder.quad(floor_square, glass, 0);
    builder.quad({{{-2, -2, 2}, {-2, 2, 2}, {2, 2, 2}, {2, -2, 2}}}, lamp, 1);
    Solution s = dark_solution(builder.build(), 1);
    const Luminaires luminaires =
        sample_luminaires(s.surface, {.first_shot = FirstShot::hemicube, .samples = 16});
    s.direct.samples = luminaires.samples;
    s.direct.shot_sides = luminaires.shot_sides;
    s.direct.geometry_factor.assign(s.direct.samples.size() * s.patches.patch_count(), 1.0f);
    s.direct.visibility = s.direct.geometry_factor;
    for (const double x : {-0.7, 0.0, 0.4})
        EXPECT_NEAR(seen(s, {x + 0.3, 0.2, 1}, {x, 0, 0}).radiance.x, 5.0f, 5e-3f);
    RenderOptions no_emission;
    no_emission.components.emission = false;
    EXPECT_EQ(seen(s, {0.3, 0.2, 1}, {0, 0, 0}, no_emission).radiance.x, 0.0f);

    no_emission.direct = DirectShading::stored;
    EXPECT_EQ(seen(s, {0.3, 0.2, 1}, {0, 0, 0}, no_emission).radiance.x, 0.0f);
    s.direct.geometry_factor.clear();
    s.direct.visibility.clear();
    s.direct.first_samples = {0};
    s.direct.vectors.assign(s.patches.patch_count(), {0.0f, 0.0f, 0.5f});
    EXPECT_EQ(seen(s, {0.3, 0.2, 1}, {0, 0, 0}, no_emission).radiance.x, 0.0f);
}

/// A room of lobes alone, lit by its ceiling, against the path tracer.
class GlossyRoom : public testing::Test {
protected:
    static void SetUpTestSuite() {
        SceneBuilder b;
        b.scene.materials[0] = glossy(Lobe::max_phong, 0.0f, 0.6f, 10, 1);
        b.scene.materials.push_back(b.scene.materials[0]);
        b.scene.materials[1].emission = Spectrum(1.0f);
        b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, 0, 1);
        b.polygon({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, 1);
        b.box({0.3, 0.3, 0.1}, {0.6, 0.7, 0.4}, Facing::outwards);
        BakeOptions options;
        options.light.first_shot = FirstShot::off;
        options.subdivision.leaf_target = 2000;
        options.iteration.iterations = 1024;
        Monitor silent;
        solution = std::make_unique<Solution>(bake(b.scene, options, Workers(), silent));
    }
    static void TearDownTestSuite() { solution.reset(); }

    static Camera camera() {
        Camera c;
        c.eye = {0.9, 0.08, 0.6};
        c.look_at = {0.2, 0.7, 0.2};
        c.up = {0, 0, 1};
        c.vertical_fov = 60.0;
        return c;
    }
    static constexpr int size = 24;
    static Image rendered(bool monte_carlo, std::uint64_t seed = 1, int iterations = 64) {
        return rendered(monte_carlo ? MonteCarloShading::rays : MonteCarloShading::off, seed,
                        iterations);
    }
    static Image rendered(MonteCarloShading how, std::uint64_t seed, int iterations) {
        RenderOptions options;
        options.monte_carlo = how;
        options.iterations = iterations;
        options.width = options.height = size;
        options.seed = seed;
        Monitor silent;
        return render_solution(*solution, camera(), options, Workers(), silent);
    }
    static Image traced(std::uint64_t seed, int samples) {
        Monitor silent;
        return path_trace(solution->surface, {}, camera(), {size, size, samples, 0, seed},
                          Workers(), silent);
    }
    static double mean_of(const Image& image) {
        double sum = 0.0;
        for (const Spectrum& p : image.pixels) sum += p.x;
        return sum / static_cast<double>(image.pixels.size());
    }

    static std::unique_ptr<Solution> solution;
};
std::unique_ptr<Solution> GlossyRoom::solution;

TEST_F(GlossyRoom, HasThePathTracersMean) {
    std::vector<double> ours, reference;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        ours.push_back(mean_of(rendered(true, seed)));
        reference.push_back(mean_of(traced(seed, 64)));
    }
    const Estimate a = estimate(ours), b = estimate(reference);
    EXPECT_LT(a.error + b.error, 0.01 * b.mean);
    // Whatever the finite elements hold; they are brighter by a sixth.
    EXPECT_NEAR(a.mean, b.mean, 5.0 * std::hypot(a.error, b.error));
    EXPECT_GT(mean_of(rendered(false)), 1.05 * b.mean) << "nothing to correct";
}

/// Pixel by pixel, the Monte-Carlo component takes away most of what the finite elements do wrong.
TEST_F(GlossyRoom, IsCorrectedByTheMonteCarloComponent) {
    const Image reference = traced(1, 1024), also = traced(2, 1024);
    const double noise = compare_images(also, reference).relative_rmse;
    const double rough = compare_images(rendered(false), reference).relative_rmse;
    const double corrected = compare_images(rendered(true, 1, 1024), reference).relative_rmse;
    EXPECT_LT(corrected, 0.5 * rough)
        << "noise " << noise << ", finite elements " << rough << ", with rays " << corrected;
}

/// Likewise by one reflection of what elements hold; what they hold stays as it is, and sub-patches
/// show it no finer than they are.
TEST_F(GlossyRoom, IsCorrectedByBundles) {
    const Image reference = traced(1, 1024);
    const double rough = compare_images(rendered(false), reference).relative_rmse;
    using enum MonteCarloShading;
    for (const auto how : {subpatch, wavefront}) {
        const double corrected = compare_images(rendered(how, 1, 1024), reference).relative_rmse;
        EXPECT_LT(corrected, 0.6 * rough) << "wavefront " << (how == wavefront);
    }
}

TEST_F(GlossyRoom, DoesNotDependOnTheNumberOfThreads) {
    RenderOptions options;
    options.width = options.height = size;
    Recorder recorder;
    const Image one = render_solution(*solution, camera(), options, Workers(1), recorder);
    ASSERT_FALSE(recorder.notes.empty());
    EXPECT_NE(recorder.notes[0].find("Monte-Carlo component, up to 64 rays"), std::string::npos);
    const Image four = render_solution(*solution, camera(), options, Workers(4), recorder);
    EXPECT_EQ(one.pixels, four.pixels);
}

TEST_F(GlossyRoom, IsTheSameForACameraThatCameLater) {
    RenderOptions options;
    options.width = options.height = size;
    Monitor silent;
    const Workers workers(2);
    SolutionRenderer renderer(*solution, options, workers, silent);
    const Camera elsewhere = narrow_camera({0.5, 0.5, 0.9}, {0.2, 0.2, 0});
    (void)renderer.render(elsewhere, workers, silent);
    EXPECT_EQ(renderer.render(camera(), workers, silent).pixels,
              render_solution(*solution, camera(), options, workers, silent).pixels);
}

}  // namespace
}  // namespace transillum
