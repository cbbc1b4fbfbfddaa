// Unit cube, one face emitting M = 1, one constant element a face, all of one albedo.
#include "physics/transport_runs.h"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

struct Case {
    float albedo;
    double emitting, opposite, side;  ///< radiosities
};

class Interreflection : public testing::TestWithParam<Case> {};

/// The two triangles of a face share one element.
PatchHierarchy element_a_face() {
    PatchHierarchy patches;
    patches.leaf_count = 6;
    for (std::uint32_t face = 0; face < 6; ++face) {
        patches.roots.insert(patches.roots.end(), 2, RootPatches{face, 0});
        patches.root_of_leaf.push_back(2 * face);
    }
    return patches;
}

TEST_P(Interreflection, OfOneElementAFace) {
    const Case& c = GetParam();
    const Scene cube = cube_scene(c.albedo, static_cast<float>(1.0 / std::numbers::pi), 0.0f);
    Monitor silent;
    const TransportRun run =
        run_transport(build_surface(cube, {}, silent), element_a_face(), {.directions = 1024});
    const auto radiosity = [&](std::uint32_t face) {
        return std::numbers::pi * run.radiance(face);
    };
    EXPECT_NEAR(radiosity(0) / c.emitting, 1.0, 0.005);
    EXPECT_NEAR(radiosity(1) / c.opposite, 1.0, 0.005);
    for (std::uint32_t side = 2; side < 6; ++side)
        EXPECT_NEAR(radiosity(side) / c.side, 1.0, 0.005) << "side " << side;
}

INSTANTIATE_TEST_SUITE_P(Albedos, Interreflection,
                         testing::Values(Case{0.2f, 1.0096154, 0.0480445, 0.0480850},
                                         Case{0.5f, 1.0909091, 0.1817458, 0.1818363},
                                         Case{0.8f, 1.5517241, 0.6895511, 0.6896812}));

}  // namespace
