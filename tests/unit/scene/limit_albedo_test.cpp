#include "unit/scene/scene_files.h"

#include <transillum/scene/brdf.h>
#include <transillum/scene/limit_albedo.h>

#include <limits>

namespace transillum {

namespace {

Scene scene_of(const Spectrum& diffuse, const Spectrum& specular) {
    Scene scene;
    Material m;
    m.name = "paint";
    m.diffuse = diffuse;
    m.specular = specular;
    m.lobe = Lobe::max_phong;
    scene.materials.push_back(m);
    return scene;
}

TEST(LimitAlbedo, ScalesBothLobesPerChannel) {
    Scene scene = scene_of({0.8f, 0.2f, 0.5f}, {0.5f, 0.1f, 0.5f});
    RecordingMonitor monitor;
    limit_albedo(scene, 0.9f, monitor);
    const Material& m = scene.materials[0];
    EXPECT_FLOAT_EQ(m.diffuse.r, 0.8f * 0.9f / 1.3f);
    EXPECT_FLOAT_EQ(m.specular.r, 0.5f * 0.9f / 1.3f);
    EXPECT_EQ(m.diffuse.g, 0.2f);
    EXPECT_EQ(m.specular.g, 0.1f);
    EXPECT_FLOAT_EQ(m.albedo().b, 0.9f);
    ASSERT_EQ(monitor.warnings.size(), 1u);
    // removed: 0.4 + 0.1 of 1.3 + 0.3 + 1.0
    EXPECT_NE(monitor.warnings[0].find("'paint' reflects 1.3 0.3 1"), std::string::npos)
        << monitor.warnings[0];
    EXPECT_NE(monitor.warnings[0].find("19 %"), std::string::npos) << monitor.warnings[0];
}

TEST(LimitAlbedo, NeverLeavesMoreThanTheLimit) {
    for (int i = 1; i <= 100; ++i) {
        for (int k = 0; k <= 100; ++k) {
            Scene scene = scene_of(Spectrum(static_cast<float>(i) / 100.0f),
                                   Spectrum(static_cast<float>(k) / 100.0f));
            Monitor quiet;
            limit_albedo(scene, 0.95f, quiet);
            EXPECT_LE(max_channel(scene.materials[0].albedo()), 0.95f) << i << ' ' << k;
        }
    }
}

/// Along the normal, and of uniform light, by the reflection model itself.
TEST(LimitAlbedo, HoldsForGgxLobes) {
    for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f})
        for (int i = 0; i <= 20; ++i)
            for (int k = 0; k <= 20; ++k) {
                const float d = static_cast<float>(i) / 20.0f, s = static_cast<float>(k) / 20.0f;
                Scene scene = scene_of({d, d, 1.0f}, {s, 0.0f, 1.0f});
                Material& m = scene.materials[0];
                m.lobe = Lobe::ggx;
                m.roughness = roughness;
                const Material before = m;
                Monitor quiet;
                limit_albedo(scene, 0.9f, quiet);
                const Brdf brdf = brdf_of(m);
                EXPECT_LE(max_channel(directional_albedo(brdf, 1.0f)), 0.9f) << d << ' ' << s;
                EXPECT_LE(max_channel(m.albedo()), 0.9f) << d << ' ' << s << ' ' << roughness;
                // both parts by the same factor
                EXPECT_FLOAT_EQ(m.diffuse.r * before.specular.r, m.specular.r * before.diffuse.r);
            }
}

TEST(LimitAlbedo, TakesNoMoreFromGgxLobesThanItMust) {
    // Smooth metal: what it reflects of uniform light, F + (1 - F) / 21, comes down to the limit.
    Scene scene = scene_of(Spectrum(0.0f), Spectrum(1.0f));
    scene.materials[0].lobe = Lobe::ggx;
    scene.materials[0].roughness = 0.0f;
    RecordingMonitor monitor;
    limit_albedo(scene, 0.9f, monitor);
    EXPECT_NEAR(scene.materials[0].specular.r, (0.9 - 1.0 / 21.0) / (20.0 / 21.0), 1e-3);
    EXPECT_EQ(monitor.warnings.size(), 1u);
    // Rough metal loses light between its facets as it is.
    scene = scene_of(Spectrum(0.0f), Spectrum(1.0f));
    scene.materials[0].lobe = Lobe::ggx;
    limit_albedo(scene, 0.9f, monitor);
    EXPECT_EQ(scene.materials[0].specular, Spectrum(1.0f));
    // Nothing is left of what mirrors more at grazing angles alone.
    scene = scene_of(Spectrum(0.5f), Spectrum(0.5f));
    scene.materials[0].lobe = Lobe::ggx;
    scene.materials[0].roughness = 0.0f;
    limit_albedo(scene, 0.01f, monitor);
    EXPECT_EQ(scene.materials[0].albedo(), Spectrum(0.0f));
}

TEST(LimitAlbedo, LeavesOthersAlone) {
    Scene scene = scene_of(Spectrum(0.5f), Spectrum(0.5f));
    RecordingMonitor monitor;
    limit_albedo(scene, 1.0f, monitor);
    EXPECT_EQ(scene.materials[0].diffuse, Spectrum(0.5f));
    EXPECT_TRUE(monitor.warnings.empty());
}

TEST(LimitAlbedo, RefusesALimitOutsideItsRange) {
    Scene scene;
    Monitor monitor;
    for (const float limit : {0.0f, -1.0f, 1.01f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_THROW(limit_albedo(scene, limit, monitor), UsageError);
}

}  // namespace

}  // namespace transillum
