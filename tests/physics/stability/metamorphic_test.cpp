// How the light of random closed rooms must change, or not, with what is done to them
// (validation H).
#include "physics/stability/random_room.h"
#include "support/closed_forms.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace transillum::stability {

namespace {

using namespace testing_support;

constexpr std::uint64_t seeds = 4;
constexpr double student = 12.92;  // so many values, once in a thousand times
constexpr std::uint32_t few_leaves = 300;

struct Run {
    std::uint64_t seed = 1;
    int threads = 2;
    std::uint32_t leaves = few_leaves;
};

Solution bake_room(const Scene& scene, const Run& run = {}) {
    BakeOptions options = few_patches();
    options.light.first_shot = FirstShot::off;
    options.subdivision.leaf_target = run.leaves;
    options.iteration.iterations = 128;
    options.seed = run.seed;
    Monitor silent;
    return bake(scene, options, Workers(run.threads), silent);
}

/// Of all that arrives, by source polygon: pieces and their order may differ.
SpectrumSum flux_onto(const Solution& s, std::uint32_t polygon) {
    SpectrumSum sum(0.0);
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        const std::uint32_t leaf = s.patches.leaf_of_patch(p);
        if (s.surface.triangles[s.patches.root_of_leaf[leaf]].source_face != polygon) continue;
        sum += area_of_leaf(s.surface, s.patches, leaf) * SpectrumSum(s.indirect_irradiance[p]);
    }
    return sum;
}

class RandomRoom : public testing::TestWithParam<int> {
protected:
    RandomRoom() : scene(random_room(GetParam(), Lit::from_floor)) {}

    /// Mean over seeds, of the light on a wall.
    template <class Difference>
    static Estimate over_seeds(Difference difference) {
        std::vector<double> values;
        for (std::size_t i = 0; i < seeds; ++i) values.push_back(difference(i));
        return estimate(values);
    }
    /// The light on either wall of the room differs by nothing but chance, and what elements that
    /// lie otherwise make of it: as much as finer ones do.
    /// \param area_scale of the other's areas
    void expect_same_light(const Scene& other, double area_scale = 1.0) const {
        std::vector<Solution> ones, finer, others;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            ones.push_back(bake_room(scene, {.seed = seed}));
            finer.push_back(bake_room(scene, {.seed = seed, .leaves = 4 * few_leaves}));
            others.push_back(bake_room(other, {.seed = seed}));
        }
        for (std::uint32_t wall = 1; wall < 6; ++wall) {
            const auto flux = [&](const Solution& s) { return flux_onto(s, wall).x; };
            const Estimate e = over_seeds([&](std::size_t i) {
                return flux(others[i]) / (area_scale * flux(ones[i])) - 1.0;
            });
            const Estimate by_elements =
                over_seeds([&](std::size_t i) { return flux(finer[i]) / flux(ones[i]) - 1.0; });
            EXPECT_NEAR(e.mean, 0.0,
                        student * (e.error + by_elements.error) + std::abs(by_elements.mean))
                << "wall " << wall;
        }
    }

    Scene scene;
};

TEST_P(RandomRoom, HasTheSameLightForAnyNumberOfThreads) {
    const Solution one = bake_room(scene, {.threads = 1});
    for (const int threads : {2, 8}) {
        const Solution many = bake_room(scene, {.threads = threads});
        EXPECT_EQ(one.indirect_irradiance, many.indirect_irradiance);
        EXPECT_EQ(one.standard_error, many.standard_error);
        EXPECT_EQ(one.coverage, many.coverage);
        EXPECT_EQ(one.spatial_error, many.spatial_error);
        EXPECT_EQ(one.relative_error, many.relative_error);
    }
}

TEST_P(RandomRoom, IsAsMuchBrighterAsItsLightToTheLastBit) {
    const Solution one = bake_room(scene);
    for (const float factor : {0x1p-80f, 2.0f, 0x1p80f}) {
        Scene other = scene;
        for (Material& m : other.materials) m.emission *= factor;
        const Solution brighter = bake_room(other);
        for (std::uint32_t p = 0; p < one.patches.patch_count(); ++p)
            ASSERT_EQ(factor * one.indirect_irradiance[p], brighter.indirect_irradiance[p]);
        EXPECT_EQ(one.relative_error, brighter.relative_error);
    }
}

// Luminances, by which a residual is judged, weigh channels unlike: it stays off here.
TEST_P(RandomRoom, TreatsItsChannelsAlike) {
    const auto permuted = [](const Spectrum& s) { return Spectrum(s.z, s.x, s.y); };
    Scene other = scene;
    for (Material& m : other.materials) {
        m.diffuse = permuted(m.diffuse);
        m.emission = permuted(m.emission);
    }
    BakeOptions options = few_patches();
    options.light.first_shot = FirstShot::off;
    options.iteration.iterations = 128;
    options.iteration.monte_carlo = MonteCarlo::off;
    Monitor silent;
    const Solution one = bake(scene, options, Workers(2), silent);
    const Solution two = bake(other, options, Workers(2), silent);
    for (std::uint32_t p = 0; p < one.patches.patch_count(); ++p)
        ASSERT_EQ(permuted(one.indirect_irradiance[p]), two.indirect_irradiance[p]);
}

TEST_P(RandomRoom, KeepsItsLightToTheLastBitWhereSizesDouble) {
    const Solution one = bake_room(scene);
    for (const double factor : {0x1p-20, 0x1p20}) {
        Scene other = scene;
        for (glm::dvec3& p : other.positions) p *= factor;
        const Solution scaled = bake_room(other);
        EXPECT_EQ(one.indirect_irradiance, scaled.indirect_irradiance);
        EXPECT_EQ(one.relative_error, scaled.relative_error);
    }
}

TEST_P(RandomRoom, KeepsItsLightWhereItIsScaled) {
    for (const double factor : {1e-3, 1e3}) {
        Scene other = scene;
        for (glm::dvec3& p : other.positions) p *= factor;
        expect_same_light(other, factor * factor);
    }
}

TEST_P(RandomRoom, KeepsItsLightWhereItIsTurned) {
    Scene other = scene;
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 1.1, glm::normalize(glm::dvec3(2, -1, 3))));
    for (glm::dvec3& p : other.positions) p = turn * p;
    expect_same_light(other);
}

// Beyond the snapping that is reported: areas change by it, over sizes of 1.
TEST_P(RandomRoom, KeepsItsLightWhereItIsMoved) {
    Scene other = scene;
    for (glm::dvec3& p : other.positions) p += glm::dvec3(1e6, -2e6, 5e5);
    const Solution moved = bake_room(other);
    EXPECT_GT(moved.surface.grid.largest_move, 0.0);
    EXPECT_LE(moved.surface.grid.largest_move,
              std::sqrt(3.0) * std::ldexp(0.5, moved.surface.grid.exponent));
    expect_same_light(other);
}

TEST_P(RandomRoom, AddsUpItsLights) {
    const auto lit = [&](float floor, float walls) {
        Scene other = scene;
        other.materials[other.polygons[0].material].emission = Spectrum(floor);
        other.materials[other.polygons[1].material].emission = Spectrum(walls);
        return other;
    };
    std::vector<Solution> by_floor, by_walls, by_both;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        by_floor.push_back(bake_room(lit(1.0f, 0.0f), {.seed = seed}));
        by_walls.push_back(bake_room(lit(0.0f, 0.7f), {.seed = seed}));
        by_both.push_back(bake_room(lit(1.0f, 0.7f), {.seed = seed}));
    }
    for (std::uint32_t wall = 1; wall < 6; ++wall) {
        const auto flux = [&](const Solution& s) { return flux_onto(s, wall).y; };
        const Estimate e = over_seeds([&](std::size_t i) {
            return (flux(by_floor[i]) + flux(by_walls[i])) / flux(by_both[i]) - 1.0;
        });
        EXPECT_NEAR(e.mean, 0.0, student * e.error + 1e-6) << "wall " << wall;
    }
}

INSTANTIATE_TEST_SUITE_P(Numbers, RandomRoom, testing::Values(1, 2, 3));

}  // namespace

}  // namespace transillum::stability
