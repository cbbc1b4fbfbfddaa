// The path tracer between glossy and textured surfaces, under lights and environments.
#include "support/closed_forms.h"
#include "unit/render/surface_builder.h"

#include <transillum/base/sampling.h>
#include <transillum/render/path_trace.h>
#include <transillum/scene/brdf.h>

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace transillum {
namespace {

using testing_support::Estimate;
using testing_support::estimate;
using testing_support::SurfaceBuilder;

constexpr double pi = std::numbers::pi;

struct Finish {
    const char* name;
    Lobe lobe;
    float diffuse, specular, shininess, roughness;
};
void PrintTo(const Finish& f, std::ostream* out) {
    *out << f.name;
}

void set(Material& m, const Finish& f) {
    m.diffuse = Spectrum(f.diffuse);
    m.specular = Spectrum(f.specular);
    m.lobe = f.lobe;
    m.shininess = f.shininess;
    m.roughness = f.roughness;
}

class Glossy : public ::testing::TestWithParam<Finish> {};

INSTANTIATE_TEST_SUITE_P(
    Finishes, Glossy,
    ::testing::Values(Finish{"Lambert", Lobe::none, 0.6f, 0.0f, 0.0f, 1.0f},
                      Finish{"MaxPhong3", Lobe::max_phong, 0.3f, 0.5f, 3.0f, 1.0f},
                      Finish{"MaxPhong200", Lobe::max_phong, 0.0f, 0.8f, 200.0f, 1.0f},
                      Finish{"Plastic", Lobe::ggx, 0.5f, 0.04f, 0.0f, 0.3f},
                      Finish{"SmoothPlastic", Lobe::ggx, 0.5f, 0.04f, 0.0f, 0.1f},
                      Finish{"Metal", Lobe::ggx, 0.0f, 0.9f, 0.0f, 0.5f}),
    [](const auto& info) { return std::string(info.param.name); });

/// A floor in the plane z = 0.
SurfaceBuilder floor_of(const Finish& finish) {
    SurfaceBuilder builder;
    const auto m = builder.material(Spectrum(0.0f));
    set(builder[m], finish);
    builder.quad({{{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}}}, m, 0);
    return builder;
}

/// Looks at the origin, so narrowly that it sees one point of the floor.
Camera narrow_camera(double cosine) {
    Camera camera;
    camera.eye = {2.0 * std::sqrt(1.0 - cosine * cosine), 0.0, 2.0 * cosine};
    camera.look_at = {0, 0, 0};
    camera.up = {0, 1, 0};
    camera.vertical_fov = 1e-3;
    return camera;
}
glm::dvec3 towards_eye(const Camera& camera) {
    return glm::normalize(camera.eye - camera.look_at);
}

/// Radiance that it sees, from independent replicates.
Estimate seen(const SurfaceMesh& mesh, const Lighting& lighting, const Camera& camera, int samples,
              int bounces = 0, int size = 1) {
    Monitor silent;
    std::vector<double> means;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        const Image image = path_trace(mesh, lighting, camera, {size, size, samples, bounces, seed},
                                       Workers(1), silent);
        double sum = 0.0;
        for (const Spectrum& pixel : image.pixels) sum += pixel.x;
        means.push_back(sum / static_cast<double>(image.pixels.size()));
    }
    return estimate(means);
}

/// Within five standard errors, which are themselves small.
void expect_seen(const Estimate& e, double exact, double relative_error, double slack = 0.0) {
    EXPECT_LT(e.error, relative_error * exact);
    EXPECT_NEAR(e.mean, exact, 5.0 * e.error + slack + 1e-5 * exact);
}

/// What a floor reflects of light from directions, by the midpoint rule over the hemisphere.
double reflected_light(const Brdf& brdf, const glm::dvec3& out, int steps,
                       const std::function<double(const glm::dvec3&)>& radiance) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const glm::dvec3 in =
                cosine_direction((i + 0.5) / steps, (j + 0.5) / steps);  // density cos / pi
            const double light = radiance(in);
            if (light > 0.0) sum += light * evaluate(brdf, in, out).x;
        }
    return pi * sum / (steps * steps);
}

Lighting under(Environment::Kind kind) {
    Lighting lighting;
    lighting.environment.kind = kind;
    lighting.environment.up = {0, 0, 1};
    return lighting;
}

TEST_P(Glossy, ReflectsItsDirectionalAlbedoOfAUniformEnvironment) {
    SurfaceBuilder builder = floor_of(GetParam());
    const SurfaceMesh mesh = builder.build();
    const Brdf brdf = brdf_of(mesh.materials[0]);
    for (const double cosine : {1.0, 0.7, 0.3, 0.1})
        expect_seen(seen(mesh, under(Environment::Kind::uniform), narrow_camera(cosine), 256),
                    directional_albedo(brdf, static_cast<float>(cosine)).x, 0.01, 1e-3);
}

/// Light sampling and BRDF sampling together, against the integral.
TEST_P(Glossy, ReflectsAnOvercastSky) {
    SurfaceBuilder builder = floor_of(GetParam());
    const SurfaceMesh mesh = builder.build();
    const Camera camera = narrow_camera(0.6);
    const Lighting lighting = under(Environment::Kind::overcast);
    const double exact =
        reflected_light(brdf_of(mesh.materials[0]), towards_eye(camera), 1500,
                        [&](const glm::dvec3& in) { return lighting.environment.radiance(in).x; });
    expect_seen(seen(mesh, lighting, camera, 512), exact, 0.01, 1e-3 * exact);
}

TEST_P(Glossy, ReflectsAnImageWithASmallSun) {
    SurfaceBuilder builder = floor_of(GetParam());
    const SurfaceMesh mesh = builder.build();
    const Camera camera = narrow_camera(0.6);
    Lighting lighting = under(Environment::Kind::image);
    auto image = std::make_shared<Texture>();
    image->width = 64;
    image->height = 32;
    image->texels.assign(64 * 32, Spectrum(0.2f));
    for (int i = 0; i < 3; ++i) image->texels[9 * 64 + 30 + i] = Spectrum(200.0f);
    image->texels[4 * 64 + 50] = Spectrum(100.0f);
    lighting.environment.image = image;
    const double exact =
        reflected_light(brdf_of(mesh.materials[0]), towards_eye(camera), 2000,
                        [&](const glm::dvec3& in) { return lighting.environment.radiance(in).x; });
    expect_seen(seen(mesh, lighting, camera, 1024), exact, 0.02, 4e-3 * exact);
}

TEST_P(Glossy, ReflectsAreaLightsSmallAndLarge) {
    for (const double half : {0.05, 1.5}) {
        SurfaceBuilder builder = floor_of(GetParam());
        const auto lamp = builder.material(Spectrum(0.0f), Spectrum(3.0f));
        const glm::dvec3 centre(-1.2, 0.2, 1.0);
        const auto at = [&](double x, double y) { return centre + glm::dvec3(x, y, 0.0) * half; };
        builder.quad({{at(-1, -1), at(-1, 1), at(1, 1), at(1, -1)}}, lamp, 1);
        const SurfaceMesh mesh = builder.build();
        // from beyond the lamp's edge, across it
        Camera camera = narrow_camera(0.6);
        const Brdf brdf = brdf_of(mesh.materials[0]);
        double exact = 0.0;
        constexpr int steps = 400;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const glm::dvec3 way =
                    at(2.0 * (i + 0.5) / steps - 1.0, 2.0 * (j + 0.5) / steps - 1.0);
                const glm::dvec3 in = glm::normalize(way);
                exact += 3.0 * evaluate(brdf, in, towards_eye(camera)).x * in.z * in.z /
                         glm::dot(way, way) * 4.0 * half * half / (steps * steps);
            }
        if (half > 1.0) camera.eye = towards_eye(camera) * 0.4;  // below the lamp
        expect_seen(seen(mesh, {}, camera, 512, 1), exact, 0.02, 1e-4 * exact);
    }
}

TEST_P(Glossy, ReflectsPunctualLightsByTheirClosedForm) {
    SurfaceBuilder builder = floor_of(GetParam());
    const SurfaceMesh mesh = builder.build();
    const Brdf brdf = brdf_of(mesh.materials[0]);
    const Camera camera = narrow_camera(0.6);
    const glm::vec3 out = towards_eye(camera);

    Lighting lighting;
    PunctualLight point;
    point.position = {-1.0, 0.5, 1.5};
    point.intensity = Spectrum(7.0f);
    PunctualLight sun;
    sun.kind = PunctualLight::Kind::directional;
    sun.direction = glm::normalize(glm::dvec3(1.0, 0.2, -1.0));
    sun.intensity = Spectrum(2.0f);
    PunctualLight below = point;
    below.position.z = -1.0;
    lighting.lights = {point, sun, below};

    const glm::dvec3 in = glm::normalize(point.position);
    const double by_point =
        7.0 * evaluate(brdf, in, out).x * in.z / glm::dot(point.position, point.position);
    const double by_sun =
        2.0 * evaluate(brdf, -sun.direction, out).x * static_cast<double>(-sun.direction.z);
    // A narrow view is not a single direction: 1e-5 radians against the lobe's width.
    const double exact = by_point + by_sun;
    // Alike in every channel, the choice of a light adds no noise.
    expect_seen(seen(mesh, lighting, camera, 4), exact, 1e-3, 1e-3 * exact);
}

TEST(PunctualLights, AreHiddenByWhatStandsBefore) {
    SurfaceBuilder builder = floor_of({"", Lobe::none, 0.5f, 0.0f, 0.0f, 1.0f});
    const auto screen = builder.material(Spectrum(0.0f));
    builder.quad({{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}}, screen, 1);
    const SurfaceMesh mesh = builder.build();
    Lighting lighting;
    lighting.lights.resize(1);
    PunctualLight& light = lighting.lights[0];
    light.position = {0, 0, 2};
    EXPECT_EQ(path_trace_irradiance(mesh, lighting, {0, 0, 0}, {0, 0, 1}, 16, 1), Spectrum(0.0f));
    light.position = {0, 0, 0.5};
    EXPECT_NEAR(path_trace_irradiance(mesh, lighting, {0, 0, 0}, {0, 0, 1}, 16, 1).x, 4.0, 1e-5);
    light.kind = PunctualLight::Kind::directional;
    EXPECT_EQ(path_trace_irradiance(mesh, lighting, {0, 0, 0}, {0, 0, 1}, 16, 1), Spectrum(0.0f));
    EXPECT_NEAR(path_trace_irradiance(mesh, lighting, {9, 0, 0}, {0, 0, 1}, 16, 1).x, 1.0, 1e-5);
}

TEST(PunctualLights, SpotsShineIntoTheirConeOnly) {
    SurfaceBuilder builder = floor_of({"", Lobe::none, 0.5f, 0.0f, 0.0f, 1.0f});
    const SurfaceMesh mesh = builder.build();
    Lighting lighting;
    lighting.lights.resize(1);
    PunctualLight& light = lighting.lights[0];
    light.kind = PunctualLight::Kind::spot;
    light.position = {0, 0, 2};
    light.outer_angle = 0.5;
    EXPECT_NEAR(path_trace_irradiance(mesh, lighting, {0, 0, 0}, {0, 0, 1}, 16, 1).x, 0.25, 1e-5);
    EXPECT_EQ(path_trace_irradiance(mesh, lighting, {2, 0, 0}, {0, 0, 1}, 16, 1), Spectrum(0.0f));
}

/// One pixel shares its paths with none; many pixels over the same view share theirs, between
/// glossy first and second surfaces.
TEST_P(Glossy, SharedPathsHaveTheMeanOfUnsharedOnes) {
    SurfaceBuilder builder;
    const auto wall = builder.material(Spectrum(0.0f)),
               lamp = builder.material(Spectrum(0.0f), Spectrum(4.0f));
    set(builder[wall], GetParam());
    builder.room({0, 0, 0}, {1, 1, 1}, {wall, wall, wall, wall, wall, wall});
    builder.quad({{{0.3, 0.3, 0.98}, {0.3, 0.7, 0.98}, {0.7, 0.7, 0.98}, {0.7, 0.3, 0.98}}}, lamp,
                 7);
    const SurfaceMesh mesh = builder.build();
    Camera camera;
    camera.eye = {0.2, 0.3, 0.5};
    camera.look_at = {0.8, 0.6, 0.2};
    camera.up = {0, 0, 1};
    camera.vertical_fov = 50.0;
    const Estimate shared = seen(mesh, {}, camera, 64, 0, 12);
    const Estimate alone = seen(mesh, {}, camera, 1 << 13);
    EXPECT_LT(shared.error + alone.error, 0.015 * alone.mean);
    EXPECT_NEAR(shared.mean, alone.mean, 5.0 * std::hypot(shared.error, alone.error));
}

TEST(Environment, IsSeenWhereEyeRaysLeave) {
    SurfaceBuilder builder = floor_of({"", Lobe::none, 0.5f, 0.0f, 0.0f, 1.0f});
    Camera camera;
    camera.eye = {0, 0, 1};
    camera.look_at = {0, 0, 2};
    camera.up = {0, 1, 0};
    Monitor silent;
    Lighting lighting = under(Environment::Kind::uniform);
    lighting.environment.radiance_scale = {1.0f, 2.0f, 3.0f};
    const Image image =
        path_trace(builder.build(), lighting, camera, {4, 4, 2, 0, 1}, Workers(1), silent);
    for (const Spectrum& pixel : image.pixels) EXPECT_EQ(pixel, Spectrum(1.0f, 2.0f, 3.0f));
}

/// A closed surface lets nothing in.
TEST(Environment, StaysOutOfAClosedRoom) {
    SurfaceBuilder builder;
    const auto wall = builder.material(Spectrum(0.8f));
    builder.room({0, 0, 0}, {1, 1, 1}, {wall, wall, wall, wall, wall, wall});
    EXPECT_EQ(path_trace_irradiance(builder.build(), under(Environment::Kind::overcast),
                                    {0.5, 0.5, 0}, {0, 0, 1}, 256, 1),
              Spectrum(0.0f));
}

std::shared_ptr<const Texture> two_halves(Spectrum left, Spectrum right) {
    auto texture = std::make_shared<Texture>();
    texture->width = 8;
    texture->height = 1;
    for (int i = 0; i < 8; ++i) texture->texels.push_back(i < 4 ? left : right);
    return texture;
}

/// A square [-1, 1]^2 at a height, u along x.
SurfaceMesh textured_square(double z, bool upwards,
                            const std::function<void(SurfaceMesh&)>& dress) {
    SurfaceBuilder builder;
    const auto m = builder.material(Spectrum(0.5f));
    if (upwards)
        builder.quad({{{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}}}, m, 0);
    else
        builder.quad({{{-1, -1, z}, {-1, 1, z}, {1, 1, z}, {1, -1, z}}}, m, 0);
    SurfaceMesh mesh = builder.build();
    for (const RootTriangle& t : mesh.triangles)
        for (const std::uint32_t vertex : t.vertices) {
            const glm::dvec3& p = mesh.positions[vertex];
            mesh.uvs.emplace_back(0.5 * (p.x + 1.0), 0.5 * (p.y + 1.0));
        }
    dress(mesh);
    return mesh;
}

TEST(Textures, ColourWhatIsReflected) {
    const SurfaceMesh mesh = textured_square(0.0, true, [](SurfaceMesh& m) {
        m.textures = {two_halves({0.1f, 0.2f, 0.3f}, {0.9f, 0.8f, 0.7f})};
        m.materials[0].textures.diffuse = 0;
    });
    Camera camera = narrow_camera(0.8);
    Monitor silent;
    for (const double x : {-0.5, 0.5}) {
        camera.eye.x += x - camera.look_at.x;
        camera.look_at.x = x;
        const Image image = path_trace(mesh, under(Environment::Kind::uniform), camera,
                                       {1, 1, 16, 0, 1}, Workers(1), silent);
        const Spectrum expected = x < 0.0 ? Spectrum(0.1f, 0.2f, 0.3f) : Spectrum(0.9f, 0.8f, 0.7f);
        for (int c = 0; c < channel_count; ++c)
            EXPECT_NEAR(image.at(0, 0)[c], expected[c], 1e-4f) << x;
    }
}

TEST(Textures, SetLobesAndTheirRoughness) {
    const SurfaceMesh mesh = textured_square(0.0, true, [](SurfaceMesh& m) {
        m.textures = {two_halves(Spectrum(0.1f), Spectrum(0.8f)),
                      two_halves(Spectrum(1.0f), Spectrum(0.4f))};
        m.materials[0].diffuse = Spectrum(0.0f);
        m.materials[0].specular = Spectrum(0.5f);
        m.materials[0].lobe = Lobe::ggx;
        m.materials[0].textures.specular = 0;
        m.materials[0].textures.roughness = 1;
    });
    Material there = mesh.materials[0];
    there.specular = Spectrum(0.8f);
    there.roughness = 0.4f;
    Camera camera = narrow_camera(0.8);
    camera.eye.x += 0.5;
    camera.look_at.x = 0.5;
    expect_seen(seen(mesh, under(Environment::Kind::uniform), camera, 256),
                directional_albedo(brdf_of(there), 0.8f).x, 0.01, 1e-3);
}

TEST(Textures, ColourWhatIsEmitted) {
    const SurfaceMesh mesh = textured_square(1.0, false, [](SurfaceMesh& m) {
        m.textures = {two_halves(Spectrum(0.0f), Spectrum(4.0f))};
        m.materials[0].diffuse = Spectrum(0.0f);
        m.materials[0].emission = Spectrum(2.0f);
        m.materials[0].textures.emission = 0;
    });
    const glm::dvec3 point(0.3, -0.2, 0.0);
    double exact = 0.0;
    constexpr int steps = 400;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const glm::dvec2 uv((i + 0.5) / steps, (j + 0.5) / steps);
            const glm::dvec3 way = glm::dvec3(2.0 * uv.x - 1.0, 2.0 * uv.y - 1.0, 1.0) - point;
            const double distance2 = glm::dot(way, way);
            exact += mesh.textures[0]->at(uv).x / (distance2 * distance2) * 4.0 / (steps * steps);
        }
    std::vector<double> values;
    for (std::uint64_t seed = 0; seed < 16; ++seed)
        values.push_back(path_trace_irradiance(mesh, {}, point, {0, 0, 1}, 1024, seed).x);
    expect_seen(estimate(values), exact, 0.005, 1e-4);
}

}  // namespace
}  // namespace transillum
