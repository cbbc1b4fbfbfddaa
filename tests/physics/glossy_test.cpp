// The white furnace of glossy surfaces: emit Le = 1 - a, and L = 1 everywhere and in every
// direction (validation A1).
#include "physics/transport_runs.h"

#include <transillum/scene/brdf.h>
#include <transillum/transport/projected_brdf.h>

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace transillum;
using namespace transillum::testing_support;

Material glossy(Lobe lobe, float diffuse, float specular, float shininess, float roughness) {
    Material m;
    m.diffuse = Spectrum(diffuse);
    m.specular = Spectrum(specular);
    m.lobe = lobe;
    m.shininess = shininess;
    m.roughness = roughness;
    return m;
}

class GlossyFurnace : public testing::TestWithParam<Material> {};

TEST_P(GlossyFurnace, IsOneInEveryBin) {
    SceneBuilder b;
    b.scene.materials[0] = GetParam();
    b.box({0, 0, 0}, {1, 1.5, 0.7}, Facing::inwards);
    TransportRun run = prepare_transport(b.scene, {.leaves = 1500});
    const GlossySides& glossy = run.sources.glossy;
    run.sources.directional_emission = [&](const GlossySide& side, const glm::vec3& out) {
        return Spectrum(1.0f) - directional_albedo(glossy.brdfs[side.brdf], out.z);
    };
    iterate_in(run, {.directions = 1024});
    for (const GlossySide& s : glossy.sides) {
        if (s.back) continue;
        for (std::uint32_t p = s.first_patch; p < s.first_patch + s.leaf_count; ++p)
            for (int k = 0; k < s.bins(); ++k)
                ASSERT_NEAR(run.result.glossy_elements[s.element(k, p)].x, 1.0f, 5e-3f)
                    << "bin " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Lobes, GlossyFurnace,
                         testing::Values(glossy(Lobe::max_phong, 0.3f, 0.4f, 10.0f, 1.0f),
                                         glossy(Lobe::max_phong, 0.0f, 0.9f, 3.0f, 1.0f),
                                         glossy(Lobe::max_phong, 0.1f, 0.8f, 60.0f, 1.0f),
                                         glossy(Lobe::ggx, 0.6f, 0.04f, 0.0f, 0.4f),
                                         glossy(Lobe::ggx, 0.0f, 0.9f, 0.0f, 0.5f)));

// What glossy walls reflect, absorb and let out adds up to what is emitted.
TEST(GlossyBox, KeepsEnergy) {
    for (const float shininess : {3.0f, 10.0f, 30.0f}) {
        SceneBuilder b;
        b.scene.materials[0] = glossy(Lobe::max_phong, 0.3f, 0.5f, shininess, 1.0f);
        b.scene.materials.push_back(b.scene.materials[0]);
        b.scene.materials[1].emission = Spectrum(1.0f);
        b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards);
        b.scene.polygons[0].material = 1;
        TransportRun run = prepare_transport(b.scene, {.leaves = 1500});
        iterate_in(run, {.directions = 1024});
        const Brdf& brdf = run.sources.glossy.brdfs[0];
        const ProjectedBrdf projected(brdf, bin_level_for(brdf));
        double emitted = 0.0, absorbed = 0.0;
        for (const GlossySide& s : run.sources.glossy.sides) {
            if (s.back) continue;
            for (std::uint32_t p = s.first_patch; p < s.first_patch + s.leaf_count; ++p) {
                const double area =
                    area_of_leaf(run.surface, run.patches, run.patches.leaf_of_patch(p));
                const double incoming = run.result.irradiance[p].x / std::numbers::pi;
                double lobe = 0.0;
                for (int k = 0; k < s.bins(); ++k)
                    lobe += double{projected.lobe_albedo(k).x} / s.bins() *
                            run.result.glossy_elements[s.element(k, p)].x;
                emitted += area * run.sources.emission[p].x;
                absorbed += area * (0.7 * incoming - lobe);
            }
        }
        EXPECT_NEAR(absorbed, emitted, 5e-3 * emitted) << "shininess " << shininess;
    }
}

}  // namespace
