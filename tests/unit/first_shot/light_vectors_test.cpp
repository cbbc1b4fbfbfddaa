// Light vectors, against the tables that they stand for.
#include "support/scene_builder.h"

#include <transillum/first_shot/shoot_direct_light.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>

namespace transillum {
namespace {

using namespace testing_support;

struct Shot {
    int samples = 16, threads = 2;
    std::vector<PunctualLight> lights;
};

/// A room with a ball in it and two lamps of different colours under its ceiling, one of them with
/// a triangle for each half.
SurfaceMesh room() {
    SceneBuilder builder;
    builder.box({-2, -2, 0}, {2, 2, 3}, Facing::inwards);
    builder.sphere({0.3, 0.2, 0.8}, 0.5, 12, Facing::outwards);
    const auto lamp = [&](double x, const Spectrum& emission) {
        builder.polygon({{x, 0, 2.5}, {x, 0.6, 2.5}, {x + 0.6, 0.6, 2.5}, {x + 0.6, 0, 2.5}},
                        builder.material(Spectrum(0.0f), emission));
    };
    lamp(-1.0, {3.0f, 2.0f, 1.0f});
    lamp(0.7, {1.0f, 2.0f, 5.0f});
    return builder.surface();
}

PatchHierarchy patches_of(const SurfaceMesh& mesh) {
    return subdivide_to_levels(std::vector<int>(mesh.triangles.size(), 2));
}

DirectLight shoot(const SurfaceMesh& mesh, FirstShot choice, const Shot& shot) {
    const Luminaires luminaires =
        sample_luminaires(mesh, {.first_shot = choice, .samples = shot.samples}, shot.lights);
    Monitor silent;
    return shoot_direct_light(mesh, patches_of(mesh), luminaires, 64, Workers(shot.threads),
                              silent);
}

/// A sun, and a bulb without extent.
std::vector<PunctualLight> lights() {
    std::vector<PunctualLight> two(2);
    two[0].kind = PunctualLight::Kind::directional;
    two[0].direction = glm::normalize(glm::dvec3(0.2, 0.1, -1.0));
    two[0].intensity = Spectrum(2.0f);
    two[1].position = {-1.5, 0.0, 1.0};
    two[1].intensity = Spectrum(3.0f, 2.0f, 2.0f);
    return two;
}

// Roundings of a normalised vector's three parts, and of its length times it.
constexpr double rounding = 4 * 0x1p-24;

TEST(LightVectors, OfOneSampleEachAreWhatTheTablesHold) {
    const SurfaceMesh mesh = room();
    const PatchHierarchy patches = patches_of(mesh);
    const DirectLight table = shoot(mesh, FirstShot::hemicube, {1, 2, lights()});
    const DirectLight light = shoot(mesh, FirstShot::vectors, {1, 2, lights()});
    ASSERT_EQ(table.columns(), 4u);
    ASSERT_EQ(light.columns(), 4u);
    EXPECT_TRUE(light.geometry_factor.empty() && light.visibility.empty());
    int lit = 0;
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
        const glm::dvec3 centre = leaf_centre(mesh, patches, patches.leaf_of_patch(p));
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(light.light(i).emitted, table.light(i).emitted);
            const double share = table.share(p, i);
            ASSERT_NEAR(light.share(p, i), share, rounding * share);
            if (!(share > 0.0)) continue;
            const glm::dvec3 a = glm::normalize(light.direction(p, i, centre)),
                             b = glm::normalize(table.direction(p, i, centre));
            EXPECT_LT(glm::distance(a, b), rounding);
            ++lit;
        }
    }
    EXPECT_GT(lit, 100);
}

TEST(LightVectors, OfManySamplesAreTheirSums) {
    const SurfaceMesh mesh = room();
    const PatchHierarchy patches = patches_of(mesh);
    const DirectLight table = shoot(mesh, FirstShot::hemicube, {16, 2, lights()});
    const DirectLight light = shoot(mesh, FirstShot::vectors, {16, 2, lights()});
    ASSERT_EQ(light.first_samples, (std::vector<std::uint32_t>{0, 16, 32, 33}));
    const auto expected = direct_irradiance(table, patches.patch_count());
    const auto found = direct_irradiance(light, patches.patch_count());
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
        for (int c = 0; c < channel_count; ++c)
            ASSERT_NEAR(found[p][c], expected[p][c], rounding * expected[p][c]);
        const glm::dvec3 centre = leaf_centre(mesh, patches, patches.leaf_of_patch(p));
        for (std::size_t v = 0; v < 2; ++v) {
            glm::dvec3 sum(0.0);
            for (std::size_t i = 16 * v; i < 16 * (v + 1); ++i)
                sum += table.share(p, i) * glm::normalize(table.direction(p, i, centre));
            if (!(light.share(p, v) > 0.0)) {
                EXPECT_EQ(sum, glm::dvec3(0.0));
                continue;
            }
            EXPECT_LT(
                glm::distance(glm::normalize(light.direction(p, v, centre)), glm::normalize(sum)),
                rounding);
        }
    }
}

TEST(LightVectors, DoNotDependOnTheNumberOfWorkers) {
    const SurfaceMesh mesh = room();
    const DirectLight one = shoot(mesh, FirstShot::vectors, {10, 1, lights()});
    for (const int threads : {2, 3, 8})
        EXPECT_EQ(one.vectors, shoot(mesh, FirstShot::vectors, {10, threads, lights()}).vectors);
}

TEST(LightVectors, TakeLessMemory) {
    const SurfaceMesh mesh = room();
    const std::uint64_t patches = patches_of(mesh).patch_count();
    const DirectLight light = shoot(mesh, FirstShot::vectors, {16, 2, {}});
    EXPECT_EQ(light_vector_bytes(2, patches), sizeof(glm::vec3) * light.vectors.size());
    // While they are made, the sums of one of them are held as well.
    const LightSampleOptions options{.first_shot = FirstShot::vectors, .samples = 16};
    const std::uint64_t estimate = first_shot_bytes(sample_luminaires(mesh, options), patches);
    EXPECT_GT(estimate, light_vector_bytes(2, patches));
    EXPECT_LT(4 * estimate, sample_table_bytes(32, patches) + 1);
}

TEST(LightVectors, AreOneForEveryColourOfALuminaire) {
    SceneBuilder builder;
    builder.box({-2, -2, 0}, {2, 2, 3}, Facing::inwards);
    const std::uint32_t m = builder.material(Spectrum(0.0f), Spectrum(1.0f));
    builder.polygon({{0, 0, 2.5}, {0, 0.6, 2.5}, {0.6, 0.6, 2.5}, {0.6, 0, 2.5}}, m);
    SurfaceMesh mesh = builder.surface();
    const LightSampleOptions options{.first_shot = FirstShot::vectors, .samples = 8};
    EXPECT_EQ(sample_luminaires(mesh, options).first_samples, std::vector<std::uint32_t>{0});

    Texture stripes;
    stripes.width = 2;
    stripes.height = 1;
    stripes.texels = {Spectrum(1.0f, 2.0f, 3.0f), Spectrum(9.0f)};
    mesh.textures = {std::make_shared<const Texture>(stripes)};
    mesh.uvs.assign(3 * mesh.triangles.size(), {0.0f, 0.0f});
    for (std::size_t r = 0; r < mesh.triangles.size(); ++r) {
        if (mesh.triangles[r].material != m) continue;
        mesh.materials[m].textures.emission = 0;
        const float u = r + 1 == mesh.triangles.size() ? 0.75f : 0.25f;
        for (std::size_t k = 0; k < 3; ++k) mesh.uvs[3 * r + k] = {u, k == 2 ? 0.01f : 0.0f};
    }
    const Luminaires striped = sample_luminaires(mesh, options);
    ASSERT_EQ(striped.first_samples, (std::vector<std::uint32_t>{0, 4}));
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_EQ(striped.samples[i].emitted, striped.samples[i / 4 * 4].emitted);
    EXPECT_NE(striped.samples[0].emitted, striped.samples[4].emitted);
}

TEST(LightVectors, OfAShotThatWasStoppedHoldWhatWasShot) {
    class Stopper : public Monitor {
    public:
        explicit Stopper(int most_) : most(most_) {}
        void progress(const Progress&) override { ++done; }
        [[nodiscard]] bool stop_requested() const override { return done >= most; }
        int most, done = 0;
    };
    const SurfaceMesh mesh = room();
    const PatchHierarchy patches = patches_of(mesh);
    std::vector<DirectLight> light;
    for (const FirstShot choice : {FirstShot::hemicube, FirstShot::vectors}) {
        Stopper stopper(5);
        const Luminaires luminaires =
            sample_luminaires(mesh, {.first_shot = choice, .samples = 4}, lights());
        light.push_back(shoot_direct_light(mesh, patches, luminaires, 32, Workers(1), stopper));
        EXPECT_EQ(stopper.done, 5);
    }
    // One worker takes sample after sample; the second lamp got one of four.
    const auto expected = direct_irradiance(light[0], patches.patch_count());
    const auto found = direct_irradiance(light[1], patches.patch_count());
    float most = 0.0f;
    for (std::uint32_t p = 0; p < patches.patch_count(); ++p) {
        for (int c = 0; c < channel_count; ++c)
            EXPECT_NEAR(found[p][c], expected[p][c], rounding * expected[p][c]);
        most = std::max(most, static_cast<float>(light[1].share(p, 1)));
        EXPECT_EQ(light[1].share(p, 2), 0.0);
    }
    EXPECT_GT(most, 0.0f);
}

TEST(LightVectors, OfNoLuminairesAreNone) {
    SceneBuilder builder;
    builder.box({-2, -2, 0}, {2, 2, 3}, Facing::inwards);
    const SurfaceMesh mesh = builder.surface();
    const DirectLight light = shoot(mesh, FirstShot::vectors, {});
    EXPECT_EQ(light.columns(), 0u);
    EXPECT_TRUE(light.vectors.empty());
    for (const Spectrum& e : direct_irradiance(light, patches_of(mesh).patch_count()))
        EXPECT_EQ(e, Spectrum(0.0f));
}

}  // namespace
}  // namespace transillum
