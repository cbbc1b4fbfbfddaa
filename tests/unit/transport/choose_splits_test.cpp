#include "support/scene_builder.h"

#include <transillum/transport/choose_splits.h>

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

/// A unit square of two roots, with the children of its leaves.
class Square : public testing::Test {
protected:
    Square() {
        SceneBuilder b;
        b.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
        Monitor silent;
        mesh_ = build_surface(b.scene, {}, silent);
        patches_ = subdivide_to_levels({3, 3});
        children_ = split_all_leaves(patches_);
    }

    [[nodiscard]] std::vector<Spectrum> on_fronts(
        const std::function<float(const glm::dvec3&)>& radiance) const {
        std::vector<Spectrum> values(children_.patches.patch_count(), Spectrum(0.0f));
        for (std::uint32_t c = 0; c < children_.patches.leaf_count; ++c)
            values[c] = Spectrum(radiance(leaf_centre(mesh_, children_.patches, c)));
        return values;
    }
    [[nodiscard]] SplitChoice choose(const std::vector<Spectrum>& radiance, float error,
                                     const SplitOptions& options = {}) const {
        return choose_splits(mesh_, patches_, children_, radiance,
                             std::vector<Spectrum>(radiance.size(), Spectrum(error)), {}, options);
    }
    [[nodiscard]] double distance_to_edge(std::uint32_t leaf) const {
        return std::abs(leaf_centre(mesh_, patches_, leaf).x - 0.5);
    }

    static float step(const glm::dvec3& p) { return p.x < 0.5 ? 1.0f : 0.0f; }

    SurfaceMesh mesh_;
    PatchHierarchy patches_;
    SplitPatches children_;
};

TEST_F(Square, OfOneRadianceStaysAsItIs) {
    EXPECT_EQ(choose(on_fronts([](const glm::dvec3&) { return 2.0f; }), 0.0f).count, 0u);
    EXPECT_EQ(choose(on_fronts([](const glm::dvec3&) { return 0.0f; }), 0.0f).count, 0u);
}

TEST_F(Square, SplitsAlongAnEdgeAndNowhereElse) {
    const SplitChoice choice = choose(on_fronts(step), 0.0f);
    const double width = 1.0 / 8.0;
    std::uint32_t count = 0;
    for (std::uint32_t leaf = 0; leaf < patches_.leaf_count; ++leaf) {
        count += choice.split[leaf];
        const double distance = distance_to_edge(leaf);
        if (distance > 0.5 * width && distance < 1.5 * width) continue;
        EXPECT_EQ(choice.split[leaf] != 0, distance < width) << leaf;
    }
    EXPECT_EQ(count, choice.count);
    EXPECT_FALSE(choice.limited);
}

TEST_F(Square, DoesNotSplitForWhatMayBeNoise) {
    EXPECT_EQ(choose(on_fronts(step), 1.01f).count, 0u);
    EXPECT_GT(choose(on_fronts(step), 0.5f).count, 0u);
}

TEST_F(Square, SplitsForDirectLightWhateverTheNoise) {
    const std::vector<Spectrum> noise(children_.patches.patch_count(), Spectrum(1.0f));
    const SplitChoice choice =
        choose_splits(mesh_, patches_, children_, noise, noise, on_fronts(step), {});
    EXPECT_GT(choice.count, 0u);
}

TEST_F(Square, StopsAtTheLimitWithTheWidestSpreads) {
    const auto two_steps = [](const glm::dvec3& p) {
        return (p.x < 0.25 ? 10.0f : 0.0f) + (p.x < 0.75 ? 1.0f : 0.0f);
    };
    const SplitChoice all = choose(on_fronts(two_steps), 0.0f);
    const std::uint32_t most = patches_.leaf_count + 3 * 8;
    const SplitChoice few = choose(on_fronts(two_steps), 0.0f, {.max_leaves = most});
    EXPECT_GT(all.count, 8u);
    EXPECT_EQ(few.count, 8u);
    EXPECT_TRUE(few.limited);
    EXPECT_EQ(split_leaves(patches_, few.split).patches.leaf_count, most);
    for (std::uint32_t leaf = 0; leaf < patches_.leaf_count; ++leaf) {
        if (!few.split[leaf]) continue;
        EXPECT_LT(std::abs(leaf_centre(mesh_, patches_, leaf).x - 0.25), 0.2) << leaf;
    }
}

TEST_F(Square, KeepsToTheDeepestLevel) {
    EXPECT_EQ(choose(on_fronts(step), 0.0f, {.max_level = 3}).count, 0u);
}

}  // namespace
