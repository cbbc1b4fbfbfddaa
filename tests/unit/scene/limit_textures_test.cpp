#include "unit/scene/scene_files.h"

#include <transillum/scene/limit_albedo.h>

namespace transillum {

namespace {

void expect_near(const Spectrum& a, const Spectrum& b) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-6f) << "channel " << c;
}

Texture texture_of(int width, std::vector<Spectrum> texels) {
    Texture t;
    t.name = "image";
    t.width = width;
    t.height = static_cast<int>(texels.size()) / width;
    t.texels = std::move(texels);
    t.build_levels();
    return t;
}

Scene textured_scene(Texture diffuse, Texture specular) {
    Scene scene;
    Material m;
    m.name = "paint";
    m.diffuse = diffuse.mean();
    m.specular = specular.mean();
    m.textures = {.diffuse = 0, .specular = 1};
    scene.textures = {std::make_shared<const Texture>(std::move(diffuse)),
                      std::make_shared<const Texture>(std::move(specular))};
    scene.materials = {m};
    return scene;
}

TEST(LimitAlbedoOfTextures, ScalesTheTexelsThatExceedIt) {
    Scene scene = textured_scene(texture_of(2, {Spectrum(0.75f), {0.5f, 1.0f, 0.5f}}),
                                 texture_of(2, {Spectrum(0.75f), {0.25f, 0.0f, 0.25f}}));
    const auto shared = scene.textures[0];
    scene.materials.push_back(scene.materials[0]);
    scene.materials.back().textures.specular = -1;
    scene.materials.back().specular = Spectrum(0.0f);
    scene.materials.back().diffuse = Spectrum(0.5f);
    scene.materials.push_back(scene.materials[0]);
    RecordingMonitor monitor;
    limit_albedo(scene, 0.875f, monitor);
    const Material& m = scene.materials[0];
    const Texture& diffuse = *scene.textures.at(static_cast<std::size_t>(m.textures.diffuse));
    const Texture& specular = *scene.textures.at(static_cast<std::size_t>(m.textures.specular));
    expect_near(diffuse.texels[0], Spectrum(0.4375f));
    expect_near(specular.texels[0], Spectrum(0.4375f));
    expect_near(diffuse.texels[1], {0.5f, 0.875f, 0.5f});
    EXPECT_EQ(specular.texels[1], Spectrum(0.25f, 0.0f, 0.25f));
    expect_near(m.diffuse, {0.46875f, 0.65625f, 0.46875f});
    EXPECT_EQ(diffuse.levels.size(), 1u);
    EXPECT_EQ(shared->texels[0], Spectrum(0.75f)) << "shared ones are left as they were";
    EXPECT_EQ(scene.materials[2].textures.diffuse, m.textures.diffuse) << "limited once";
    EXPECT_TRUE(RecordingMonitor::any_names(monitor.warnings,
                                            "'paint' reflects up to 1.5 1.5 1.5, above the limit"));
    // Those of materials 0 and 2, and the limited diffuse texture of material 1; none is unused.
    EXPECT_EQ(scene.textures.size(), 3u);
}

TEST(LimitAlbedoOfTextures, LeavesOthersAlone) {
    Scene scene = textured_scene(texture_of(2, {Spectrum(0.5f), Spectrum(0.25f)}),
                                 texture_of(1, {Spectrum(0.25f), Spectrum(0.5f)}));
    const auto before = scene.textures;
    RecordingMonitor monitor;
    limit_albedo(scene, 1.0f, monitor);
    EXPECT_EQ(scene.textures, before);
    EXPECT_TRUE(monitor.warnings.empty());
}

TEST(LimitAlbedoOfTextures, HoldsEverywhereBetweenTexelsOfDifferentGrids) {
    Scene scene = textured_scene(
        texture_of(3, {Spectrum(0.9f), Spectrum(0.1f), Spectrum(0.6f)}),
        texture_of(2, {Spectrum(0.8f), Spectrum(0.3f), Spectrum(0.0f), Spectrum(0.9f)}));
    Monitor quiet;
    limit_albedo(scene, 0.95f, quiet);
    const MaterialTextures& t = scene.materials[0].textures;
    const Texture& diffuse = *scene.textures.at(static_cast<std::size_t>(t.diffuse));
    const Texture& specular = *scene.textures.at(static_cast<std::size_t>(t.specular));
    for (int i = 0; i < 97; ++i) {
        for (int k = 0; k < 97; ++k) {
            const glm::vec2 uv(static_cast<float>(i) / 97.0f, static_cast<float>(k) / 97.0f);
            EXPECT_LE((diffuse.at(uv) + specular.at(uv)).x, 0.95f + 2 * 0x1p-23f);
        }
    }
}

TEST(LimitAlbedoOfTextures, AUniformLobeIsLimitedWhereTheOtherIsStrong) {
    Scene scene = textured_scene(texture_of(2, {Spectrum(1.0f), Spectrum(0.0f)}),
                                 texture_of(1, {Spectrum(0.5f)}));
    scene.materials[0].textures.specular = -1;
    Monitor quiet;
    limit_albedo(scene, 0.75f, quiet);
    const MaterialTextures& t = scene.materials[0].textures;
    const Texture& specular = *scene.textures.at(static_cast<std::size_t>(t.specular));
    expect_near(specular.texels[0], Spectrum(0.25f));
    expect_near(specular.texels[1], Spectrum(0.5f));
    expect_near(scene.materials[0].specular, Spectrum(0.375f));
    expect_near(scene.materials[0].diffuse, Spectrum(0.25f));
}

}  // namespace

}  // namespace transillum
