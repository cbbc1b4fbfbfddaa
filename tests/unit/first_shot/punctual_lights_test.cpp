// First shot of lights without extent, against closed forms.
#include "support/closed_forms.h"
#include "support/scene_builder.h"

#include <transillum/first_shot/shoot_direct_light.h>
#include <transillum/scene/photometry.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <functional>
#include <numbers>

namespace transillum {
namespace {

using namespace testing_support;
constexpr double pi = std::numbers::pi;

struct Shot {
    int level = 3, resolution = 256, threads = 2;
    std::uint64_t seed = 1;
};

struct Lit {
    SurfaceMesh mesh;
    PatchHierarchy patches;
    Lighting lighting;
    DirectLight direct;
    std::vector<Spectrum> irradiance;

    Lit(const SceneBuilder& builder, const std::vector<PunctualLight>& lights, const Shot& shot)
        : mesh(builder.surface()),
          patches(subdivide_to_levels(std::vector<int>(mesh.triangles.size(), shot.level))) {
        lighting.lights = lights;
        const Luminaires luminaires = sample_luminaires(mesh, {.seed = shot.seed}, lights);
        Monitor silent;
        direct = shoot_direct_light(mesh, patches, luminaires, shot.resolution,
                                    Workers(shot.threads), silent);
        irradiance = direct_irradiance(direct, patches.patch_count());
    }

    [[nodiscard]] std::uint32_t polygon_of(std::uint32_t patch) const {
        return mesh.triangles[patches.root_of_leaf[patches.leaf_of_patch(patch)]].source_face;
    }
    [[nodiscard]] double area_of(std::uint32_t patch) const {
        return area_of_leaf(mesh, patches, patches.leaf_of_patch(patch));
    }
    [[nodiscard]] double flux() const {
        double sum = 0.0;
        for (std::uint32_t p = 0; p < patches.patch_count(); ++p)
            sum += area_of(p) * irradiance[p].x;
        return sum;
    }
    [[nodiscard]] glm::dvec3 normal(std::uint32_t patch) const {
        return normal_of(mesh, patches.root_of_leaf[patches.leaf_of_patch(patch)]) *
               (patches.is_back(patch) ? -1.0 : 1.0);
    }
    [[nodiscard]] glm::dvec3 centre(std::uint32_t leaf) const {
        return leaf_centre(mesh, patches, leaf);
    }
    /// As if unoccluded, at a point.
    [[nodiscard]] double incident(const glm::dvec3& point, const glm::dvec3& n) const {
        double sum = 0.0;
        for (const LightSample& s : direct.samples) {
            const Incident i = incident_light(s, lighting, point);
            sum += i.irradiance.x * std::max(0.0, glm::dot(i.direction, n));
        }
        return sum;
    }
    /// Mean over a leaf, by the midpoints of 256 parts.
    [[nodiscard]] double mean_incident(std::uint32_t leaf) const {
        const std::uint32_t root = patches.root_of_leaf[leaf];
        const auto [c, level] = leaf_corners(patches, leaf);
        const PatchHierarchy parts = subdivide_to_levels({4});
        double sum = 0.0;
        for (std::uint32_t part = 0; part < parts.leaf_count; ++part) {
            glm::dvec3 point(0.0);
            for (const glm::ivec2& b : leaf_corners(parts, part).b) {
                const glm::ivec2 fine = 16 * c[0] + b.x * (c[1] - c[0]) + b.y * (c[2] - c[0]);
                point += point_of_root(mesh, root, fine, level + 4) / 3.0;
            }
            sum += incident(point, normal(leaf)) / parts.leaf_count;
        }
        return sum;
    }
};

SceneBuilder room() {
    SceneBuilder builder;
    builder.box({-2, -2, -2}, {2, 2, 2}, Facing::inwards);
    return builder;
}

/// Every front patch of a convex room over several turns: the worst within six standard errors, the
/// mean within `whole` of the closed form.
void expect_closed_form(const PunctualLight& light, double whole) {
    constexpr int replicates = 8;
    std::vector<Lit> lit;
    for (std::uint64_t seed = 1; seed <= replicates; ++seed)
        lit.emplace_back(room(), std::vector{light}, Shot{.seed = seed});
    double found = 0.0, expected = 0.0;
    for (std::uint32_t leaf = 0; leaf < lit[0].patches.leaf_count; ++leaf) {
        std::vector<double> values;
        for (const Lit& l : lit) values.push_back(l.irradiance[leaf].x);
        const Estimate e = estimate(values);
        const double exact = lit[0].mean_incident(leaf);
        // Where all turns agree to the last bits, the 256 midpoints of the closed form do not.
        EXPECT_NEAR(e.mean, exact, 6.0 * e.error + 2e-4 * exact) << leaf;
        found += e.mean;
        expected += exact;
        EXPECT_EQ(lit[0].irradiance[lit[0].patches.leaf_count + leaf], Spectrum(0.0f));
    }
    EXPECT_NEAR(found / expected, 1.0, whole);
}

PunctualLight point_light(double intensity) {
    PunctualLight light;
    light.intensity = Spectrum(static_cast<float>(intensity));
    return light;
}

/// CIE 171:2006, case 5.8: 10 000 lm at the centre of a cube of 4 m.
TEST(PointLight, GivesTheDirectIlluminancesOfCie171) {
    const Lit lit(room(), {point_light(10000.0 / (4.0 * pi))}, {.level = 4, .resolution = 512});
    EXPECT_NEAR(lit.incident({0, 0, -2}, {0, 0, 1}), 198.94, 0.005);
    EXPECT_NEAR(lit.incident({2, 2, -2}, {0, 0, 1}), 38.29, 0.005);
    EXPECT_NEAR(lit.flux() / 96.0, 104.1667, 1e-4 * 104.1667);
    double lowest = 1e9, highest = 0.0;
    for (std::uint32_t leaf = 0; leaf < lit.patches.leaf_count; ++leaf) {
        lowest = std::min(lowest, double{lit.irradiance[leaf].x});
        highest = std::max(highest, double{lit.irradiance[leaf].x});
        // Light varies by up to 30 % within a leaf of some 30 pixels' edge: half a pixel of it.
        EXPECT_NEAR(lit.irradiance[leaf].x / lit.mean_incident(leaf), 1.0, 0.3 * 0.5 / 30.0);
        EXPECT_EQ(lit.direct.visibility[leaf], 1.0f);
    }
    // Leaves are a quarter of a metre wide: the extremes are off by what they vary within one.
    EXPECT_NEAR(highest, 198.94, 0.02 * 198.94);
    EXPECT_GT(lowest, 38.29 * 0.99);
    EXPECT_LT(lowest, 38.29 * 1.15);
}

TEST(PointLight, AgreesWithTheClosedFormAnywhereInARoom) {
    PunctualLight light = point_light(100.0);
    light.position = {0.7, -1.1, 0.4};
    expect_closed_form(light, 1e-4);
}

TEST(SpotLight, AgreesWithTheClosedForm) {
    PunctualLight spot = point_light(100.0);
    spot.kind = PunctualLight::Kind::spot;
    spot.position = {0.3, 0.2, 1.0};
    spot.direction = glm::normalize(glm::dvec3(0.2, -0.3, -1.0));
    spot.inner_angle = 0.3;
    spot.outer_angle = 0.7;
    // Pixels follow the falloff by their centres; over turns that cancels.
    expect_closed_form(spot, 1e-3);
    const Lit lit(room(), {spot}, {});
    EXPECT_NEAR(lit.flux() / spot.flux().x, 1.0, 1e-3);
}

TEST(PhotometricLight, SendsItsFlux) {
    auto table = std::make_shared<Photometry>();
    table->vertical = {0, 45, 90, 180};
    table->horizontal = {0, 90, 180};
    table->candela = {10, 20, 5, 0, 10, 8, 4, 0, 10, 3, 2, 0};
    PunctualLight light;
    light.photometry = table;
    light.intensity = Spectrum(3.0f);
    light.direction = glm::normalize(glm::dvec3(0.3, 0.4, -1.0));
    const Lit lit(room(), {light}, {});
    EXPECT_NEAR(lit.flux() / (3.0 * table->flux()), 1.0, 2e-3);
    expect_closed_form(light, 2e-3);
}

TEST(PointLight, CastsShadows) {
    SceneBuilder builder = room();
    builder.polygon({{-0.5, -0.5, -1}, {0.5, -0.5, -1}, {0.5, 0.5, -1}, {-0.5, 0.5, -1}});
    const Lit lit(builder, {point_light(100.0)}, {.level = 4});
    for (std::uint32_t p = 0; p < lit.patches.leaf_count; ++p) {
        if (lit.polygon_of(p) != 0) continue;
        // Twice as wide at twice the distance; leaves are 0.35 across.
        const glm::dvec3 c = glm::abs(lit.centre(p));
        const double off = std::max(c.x, c.y);
        EXPECT_TRUE(off > 0.8 || lit.irradiance[p].x == 0.0f) << c.x << ' ' << c.y;
        EXPECT_TRUE(off < 1.2 || lit.direct.visibility[p] == 1.0f) << c.x << ' ' << c.y;
    }
    // Nothing is lost: the screen gets what the floor lacks.
    EXPECT_NEAR(lit.flux(), 400.0 * pi, 400.0 * pi * 2e-3);
}

PunctualLight sun_along(const glm::dvec3& direction, double irradiance = 1.0) {
    PunctualLight sun;
    sun.kind = PunctualLight::Kind::directional;
    sun.direction = glm::normalize(direction);
    sun.intensity = Spectrum(static_cast<float>(irradiance));
    return sun;
}

TEST(DirectionalLight, GivesTheCosine) {
    SceneBuilder builder;
    builder.polygon({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
    for (const glm::dvec3& way : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0.5, -0.7)}) {
        const Lit lit(builder, {sun_along(way, 800.0)}, {});
        const auto exact = static_cast<float>(-800.0 * glm::normalize(way).z);
        for (std::uint32_t leaf = 0; leaf < lit.patches.leaf_count; ++leaf) {
            EXPECT_NEAR(lit.irradiance[leaf].x, exact, 1e-6f * exact);
            EXPECT_NEAR(lit.incident(lit.centre(leaf), {0, 0, 1}), exact, 1e-6 * exact);
            EXPECT_EQ(lit.irradiance[lit.patches.leaf_count + leaf], Spectrum(0.0f));
        }
    }
    // From below the back is lit.
    const Lit below(builder, {sun_along({0, 0, 1})}, {});
    EXPECT_EQ(below.irradiance[0], Spectrum(0.0f));
    EXPECT_EQ(below.irradiance[below.patches.leaf_count], Spectrum(1.0f));
}

TEST(DirectionalLight, CastsTheShadowsArea) {
    SceneBuilder builder;
    builder.polygon({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
    builder.polygon({{-0.5, -0.5, 0.7}, {0.5, -0.5, 0.7}, {0.5, 0.5, 0.7}, {-0.5, 0.5, 0.7}});
    const PunctualLight sun = sun_along({0.6, 0.3, -1.0});
    std::vector<double> areas;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const Lit lit(builder, {sun}, {.level = 4, .resolution = 256, .seed = seed});
        double shadow = 0.0;
        for (std::uint32_t leaf = 0; leaf < lit.patches.leaf_count; ++leaf) {
            if (lit.polygon_of(leaf) == 0)
                shadow += lit.area_of(leaf) * (1.0 - lit.direct.visibility[leaf]);
            else
                EXPECT_EQ(lit.direct.visibility[leaf], 1.0f);
        }
        areas.push_back(shadow);
        // A pixel of 5 mm (1024 across), wider on the floor by 1 / cos: one along the outline.
        const double pixel = 4.35 / 1024.0 / -sun.direction.z;
        EXPECT_NEAR(shadow, 1.0, 4.0 * pixel);
    }
    const Estimate e = estimate(areas);
    EXPECT_LT(e.error, 1e-3);
    EXPECT_NEAR(e.mean, 1.0, 6.0 * e.error);
}

TEST(DirectionalLight, FindsPatchesBetweenPixels) {
    SceneBuilder builder;
    builder.polygon({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
    builder.polygon({{-0.5, -0.5, 0.7}, {0.5, -0.5, 0.7}, {0.5, 0.5, 0.7}, {-0.5, 0.5, 0.7}});
    // 64 pixels across, leaves of a 64th: most are missed.
    const Lit lit(builder, {sun_along({0, 0, -1})}, {.level = 6, .resolution = 16});
    int shadowed = 0;
    for (std::uint32_t leaf = 0; leaf < lit.patches.leaf_count; ++leaf) {
        if (lit.polygon_of(leaf) != 0) continue;
        const glm::dvec3 c = glm::abs(lit.centre(leaf));
        const double off = std::max(c.x, c.y) - 0.5;
        if (std::abs(off) < 0.1) continue;  // within a pixel and a leaf
        EXPECT_EQ(lit.direct.visibility[leaf], off > 0.0 ? 1.0f : 0.0f) << c.x << ' ' << c.y;
        shadowed += off < 0.0;
    }
    EXPECT_GT(shadowed, 100);
}

TEST(DirectionalLight, DoesNotEnterAClosedRoom) {
    SceneBuilder builder = room();
    builder.sphere({0.1, 0.2, 0.3}, 0.5, 16, Facing::outwards);
    const Lit lit(builder, {sun_along({0.3, 0.8, -0.5})}, {.level = 2});
    for (std::uint32_t leaf = 0; leaf < lit.patches.leaf_count; ++leaf)
        EXPECT_EQ(lit.irradiance[leaf], Spectrum(0.0f));
    // All that falls on the room falls on its outer side: its shadow's area.
    const glm::dvec3 d = glm::abs(lit.lighting.lights[0].direction);
    EXPECT_NEAR(lit.flux(), 16.0 * (d.x + d.y + d.z), 1e-5 * lit.flux());
}

std::vector<PunctualLight> three_lights() {
    PunctualLight spot = point_light(50.0);
    spot.kind = PunctualLight::Kind::spot;
    spot.position = {1, 0, 1};
    PunctualLight point = point_light(10.0);
    point.position = {-1, 0.5, 0};
    return {sun_along({0.2, 0.1, -1}), point, spot};
}

SceneBuilder open_room() {
    SceneBuilder builder;
    builder.box({-2, -2, -2}, {2, 2, 2}, Facing::inwards, 0, 1);
    builder.sphere({0, 0, -1}, 0.5, 12, Facing::outwards);
    return builder;
}

TEST(PunctualLights, DoNotDependOnTheNumberOfWorkers) {
    const Lit one(open_room(), three_lights(), {.level = 2, .resolution = 64, .threads = 1});
    for (const int threads : {2, 5}) {
        const Lit many(open_room(), three_lights(),
                       {.level = 2, .resolution = 64, .threads = threads});
        EXPECT_EQ(one.direct.geometry_factor, many.direct.geometry_factor);
        EXPECT_EQ(one.direct.visibility, many.direct.visibility);
    }
    const Lit reseeded(open_room(), three_lights(), {.level = 2, .resolution = 64, .seed = 2});
    EXPECT_NE(one.direct.visibility, reseeded.direct.visibility);
}

TEST(PunctualLights, AddUp) {
    std::vector<Lit> alone;
    for (const PunctualLight& light : three_lights())
        alone.emplace_back(open_room(), std::vector{light}, Shot{.level = 2, .resolution = 128});
    const Lit all(open_room(), three_lights(), {.level = 2, .resolution = 128});
    const double sum = alone[0].flux() + alone[1].flux() + alone[2].flux();
    EXPECT_NEAR(all.flux() / sum, 1.0, 2e-3);  // turned differently
}

TEST(PunctualLights, StopWhenAsked) {
    class Stopper : public Monitor {
    public:
        void progress(const Progress&) override { ++done; }
        [[nodiscard]] bool stop_requested() const override { return done > 0; }
        int done = 0;
    } stopper;
    const SurfaceMesh mesh = open_room().surface();
    const PatchHierarchy patches = subdivide_to_levels(std::vector<int>(mesh.triangles.size(), 0));
    const Luminaires luminaires = sample_luminaires(mesh, {}, three_lights());
    const DirectLight direct =
        shoot_direct_light(mesh, patches, luminaires, 32, Workers(1), stopper);
    EXPECT_EQ(stopper.done, 1);
    EXPECT_EQ(direct.visibility.size(), 3u * patches.patch_count());
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p)
        EXPECT_EQ(direct.geometry_factor[3 * p], 0.0f) << "the directional light was to come";
}

TEST(SampleLuminaires, GivesEveryLightASample) {
    SceneBuilder builder = room();
    builder.polygon({{-0.1, -0.1, 1}, {-0.1, 0.1, 1}, {0.1, 0.1, 1}, {0.1, -0.1, 1}},
                    builder.material(Spectrum(0.0f), Spectrum(1.0f)));
    const SurfaceMesh mesh = builder.surface();
    const auto lights = three_lights();
    for (const FirstShot choice : {FirstShot::off, FirstShot::automatic}) {
        const Luminaires l =
            sample_luminaires(mesh, {.first_shot = choice, .samples = 8, .seed = 5}, lights);
        const std::size_t of_surfaces = choice == FirstShot::off ? 0 : 8;
        ASSERT_EQ(l.samples.size(), of_surfaces + 3);
        EXPECT_EQ(l.count, 1u);
        EXPECT_EQ(l.seed, 5u);
        for (std::uint32_t i = 0; i < 3; ++i) {
            const LightSample& s = l.samples[of_surfaces + i];
            EXPECT_EQ(s.kind, i == 0 ? LightSample::Kind::directional : LightSample::Kind::point);
            EXPECT_EQ(s.light, i);
            EXPECT_EQ(s.emitted, lights[i].intensity);
            EXPECT_EQ(s.normal, lights[i].direction);
        }
    }
}

TEST(FirstShotBytes, AreWhatItsTablesTake) {
    const Lit lit(room(), three_lights(), {.level = 1, .resolution = 16});
    EXPECT_EQ(sample_table_bytes(lit.direct.samples.size(), lit.patches.patch_count()),
              sizeof(float) * (lit.direct.geometry_factor.size() + lit.direct.visibility.size()));
    EXPECT_EQ(sample_table_bytes(1u << 20, std::uint64_t{1} << 31), std::uint64_t{1} << 54);
}

TEST(IncidentLight, OfAPieceOfASurfaceLeavesItsFrontAlone) {
    LightSample piece;
    piece.position = {0, 0, 2};
    piece.normal = {0, 0, -1};
    piece.area = 0.5;
    piece.emitted = Spectrum(8.0f);
    const Incident below = incident_light(piece, {}, {0, 0, 0});
    EXPECT_EQ(below.direction, glm::dvec3(0, 0, 1));
    EXPECT_EQ(below.distance, 2.0);
    EXPECT_EQ(below.irradiance, Spectrum(1.0f));
    EXPECT_EQ(incident_light(piece, {}, {0, 0, 3}).irradiance, Spectrum(0.0f));
    EXPECT_EQ(incident_light(piece, {}, {0, 0, 2}).irradiance, Spectrum(0.0f));
}

}  // namespace
}  // namespace transillum
