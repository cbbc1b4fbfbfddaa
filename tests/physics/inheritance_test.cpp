// Going on from the sums of an earlier run (paper §3.2: children inherit them).
#include "physics/transport_runs.h"

#include <transillum/geometry/split_leaves.h>
#include <transillum/visibility/transillumination_buffer.h>

#include <gtest/gtest.h>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

TransportResult iterate_on(const TransportRun& run, std::uint64_t directions,
                           std::shared_ptr<const IterationSums> start = nullptr,
                           MonteCarlo monte_carlo = MonteCarlo::off) {
    Monitor silent;
    IterationOptions options;
    options.iterations = directions;
    options.pixel_size = pixel_size_for(run.surface, 200);
    options.start = std::move(start);
    options.keep_sums = true;
    options.monte_carlo = monte_carlo;
    return iterate(run.surface, run.patches, run.sources, options, Workers(2), silent);
}

Material glossy_material() {
    Material m;
    m.diffuse = Spectrum(0.3f);
    m.specular = Spectrum(0.4f);
    m.lobe = Lobe::max_phong;
    m.shininess = 10.0f;
    return m;
}

Scene glossy_cube() {
    Scene scene = cube_scene(0.3f, 1.0f, 0.0f);
    for (Material& m : scene.materials) {
        const Spectrum emission = m.emission;
        m = glossy_material();
        m.emission = emission;
    }
    return scene;
}

class Inherited : public testing::TestWithParam<bool> {
protected:
    static TransportRun prepare(std::uint32_t leaves) {
        return prepare_transport(GetParam() ? glossy_cube() : cube_scene(0.7f, 1.0f, 0.0f),
                                 {.leaves = leaves});
    }
};

INSTANTIATE_TEST_SUITE_P(Surfaces, Inherited, testing::Bool(),
                         [](const auto& i) { return i.param ? "Glossy" : "Diffuse"; });

// To the last bit, where both end blocks at the same directions.
TEST_P(Inherited, TwoRunsAreOne) {
    const TransportRun run = prepare(300);
    const TransportResult whole = iterate_on(run, 512);
    const TransportResult half = iterate_on(run, 256);
    const TransportResult rest = iterate_on(run, 512, half.sums);
    EXPECT_EQ(rest.iterations, 512u);
    EXPECT_EQ(whole.irradiance, rest.irradiance);
    EXPECT_EQ(whole.glossy_elements, rest.glossy_elements);
    EXPECT_EQ(whole.coverage, rest.coverage);
    EXPECT_EQ(whole.standard_error, rest.standard_error);
    EXPECT_EQ(whole.escaped, rest.escaped);
}

TEST_P(Inherited, ChildrenHaveTheirParentsRadianceAndAQuarterOfItsCoverage) {
    TransportRun run = prepare(300);
    const TransportResult parents = iterate_on(run, 128);
    const SplitPatches split = split_all_leaves(run.patches);
    TransportRun fine = prepare_transport(run.surface, split.patches);
    const TransportResult children = iterate_on(fine, 128, parents.sums);
    ASSERT_EQ(children.iterations, 128u);
    for (std::uint32_t child = 0; child < split.patches.leaf_count; ++child) {
        const std::uint32_t parent = split.parent[child];
        ASSERT_FLOAT_EQ(children.irradiance[child].x, parents.irradiance[parent].x);
        ASSERT_FLOAT_EQ(children.coverage[child], 0.25f * parents.coverage[parent]);
    }
    // And back: a union of all children is the parent again.
    const TransportResult united = iterate_on(run, 128, children.sums);
    for (std::uint32_t leaf = 0; leaf < run.patches.leaf_count; ++leaf) {
        ASSERT_FLOAT_EQ(united.irradiance[leaf].x, parents.irradiance[leaf].x);
        ASSERT_FLOAT_EQ(united.coverage[leaf], parents.coverage[leaf]);
    }
    for (std::size_t e = 0; e < united.glossy_elements.size(); ++e)
        ASSERT_NEAR(united.glossy_elements[e].x, parents.glossy_elements[e].x,
                    1e-5f * parents.glossy_elements[e].x);
}

// The estimate gets better where it is gone on with, on whichever patches.
TEST(Inheritance, ConvergesOnTheChildren) {
    TransportRun run = prepare_transport(cube_scene(0.8f, 1.0f, 0.0f), {.leaves = 100});
    const TransportResult parents = iterate_on(run, 128);
    TransportRun fine = prepare_transport(run.surface, split_all_leaves(run.patches).patches);
    fine.result = iterate_on(fine, 1024, parents.sums);
    EXPECT_NEAR(fine.mean_incoming(all_fronts) * 6.0 * 0.2, 1.0, 2e-3);
    const TransportResult fresh = iterate_on(fine, 4096);
    double difference = 0.0, sum = 0.0;
    for (std::uint32_t p = 0; p < fine.patches.leaf_count; ++p) {
        difference += std::abs(fine.result.irradiance[p].x - fresh.irradiance[p].x);
        sum += fresh.irradiance[p].x;
    }
    EXPECT_LT(difference / sum, 0.02);
}

TEST(Inheritance, TakesBinsAlong) {
    SceneBuilder b;
    b.scene = glossy_cube();
    TransportRun coarse = prepare_transport(b.scene, {.leaves = 100});
    const auto with_level = [&](TransportRun& run, std::int8_t level) {
        std::vector<std::int8_t> levels = choose_bin_levels(run.surface, {});
        for (std::int8_t& l : levels) l = l < 0 ? l : level;
        run.sources.glossy = lay_out_glossy_sides(run.surface, run.patches, levels);
    };
    TransportRun fine = coarse;
    with_level(coarse, 1);
    with_level(fine, 2);
    const TransportResult of_coarse = iterate_on(coarse, 256);
    const TransportResult of_fine = iterate_on(fine, 256, of_coarse.sums);
    for (std::size_t i = 0; i < coarse.sources.glossy.sides.size(); ++i) {
        const GlossySide& c = coarse.sources.glossy.sides[i];
        const GlossySide& f = fine.sources.glossy.sides[i];
        for (std::uint32_t p = c.first_patch; p < c.first_patch + c.leaf_count; ++p)
            for (int k = 0; k < f.bins(); ++k) {
                const int parent = (k / 4 / 2) * 2 + k % 4 / 2;
                ASSERT_FLOAT_EQ(of_fine.glossy_elements[f.element(k, p)].x,
                                of_coarse.glossy_elements[c.element(parent, p)].x);
            }
    }
}

// The component begins anew with every run, from the first direction that is late enough.
TEST(Inheritance, CarriesOnOnceThereAreElements) {
    const TransportRun run = prepare_transport(cube_scene(0.7f, 1.0f, 0.0f), {.leaves = 100});
    const TransportResult first = iterate_on(run, 256);
    const TransportResult second = iterate_on(run, 512, first.sums, MonteCarlo::subpatch);
    EXPECT_EQ(second.carried, 256u);
}

}  // namespace
