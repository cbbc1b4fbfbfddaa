// Textures are read back as they were written, in the formats that hold any.
#include "unit/scene/saved_scenes.h"

namespace transillum {

namespace {

using testing_support::expect_same_materials;
using testing_support::expect_same_polygons;

/// Half a step of 16 bits where the curve of sRGB is steepest, and of metalness.
constexpr float texel_rounding = 0.5f / 65535.0f * (2.28f + 1.0f) + 1e-6f;

Spectrum mean_of(const Scene& scene, std::int32_t texture) {
    return scene.textures.at(texture)->mean();
}

TEST_F(SaveScene, TexturesOf8BitsAreKeptToTheBit) {
    std::vector<Material> materials{named("a"), named("b"), named("no texture")};
    Scene scene = two_objects(materials);
    const auto plain = add_texture(scene, 7, 5, [](int i) {
        return Spectrum(of_8_bits(7 * i), of_8_bits(i + 100), of_8_bits(3 * i));
    });
    const auto bright = add_texture(scene, 16, 16, [](int i) {
        return Spectrum(of_8_bits(i), of_8_bits(255 - i), 0.0f) * Spectrum(17.0f, 0.3f, 1.0f);
    });
    for (Material& m : scene.materials) m.diffuse = Spectrum(0.5f);
    scene.materials[0].textures.diffuse = plain;
    scene.materials[0].diffuse = mean_of(scene, plain);
    scene.materials[1].textures = {.diffuse = plain, .emission = bright};
    scene.materials[1].diffuse = mean_of(scene, plain);
    scene.materials[1].emission = mean_of(scene, bright);
    scene.materials[1].back_reflects = true;
    const Scene from_obj = save_and_load(scene, "x.obj");
    expect_same_materials(scene, from_obj, 0.0f);
    expect_same_polygons(scene, from_obj);
    EXPECT_TRUE(monitor_.notes.empty()) << monitor_.notes[0];
    scene.materials[1].back_emits = true;
    for (const char* name : {"x.gltf", "x.glb"})
        expect_same_materials(scene, save_and_load(scene, name), rounding);
    for (const std::string& note : monitor_.notes)
        EXPECT_EQ(note.find("16 bits"), std::string::npos) << note;
    EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];
    EXPECT_EQ(listing().count("x-texture-2.png"), 1u);
}

TEST_F(SaveScene, OtherTexturesAreKeptWithinTheStepOf16Bits) {
    Scene scene = two_objects({named("a")});
    scene.materials[0].textures.diffuse = add_texture(scene, 9, 8, [](int i) {
        return Spectrum(0.013f * static_cast<float>(i), 0.001f * static_cast<float>(i), 0.9f);
    });
    scene.materials[0].textures.emission = add_texture(scene, 9, 8, [](int i) {
        return Spectrum(0.013f * static_cast<float>(i * i), static_cast<float>(i), 0.9f);
    });
    Material& m = scene.materials[0];
    m.diffuse = mean_of(scene, m.textures.diffuse);
    m.emission = mean_of(scene, m.textures.emission);
    expect_same_materials(scene, save_and_load(scene, "x.obj"), rounding, texel_rounding);
    m.back_emits = true;
    expect_same_materials(scene, save_and_load(scene, "x.gltf"), rounding, texel_rounding);
    EXPECT_TRUE(RecordingMonitor::any_names(monitor_.notes, "16 bits a channel"));
}

/// Base colour, metalness and roughness that vary, as a glTF file would have them.
TEST_F(SaveScene, GltfSolvesForBaseColourAndMetalness) {
    Scene scene = two_objects({named("a"), named("b")});
    const auto base = [](int i) {
        return Spectrum(of_8_bits(5 * i), of_8_bits(i + 30), of_8_bits(2 * i + 9));
    };
    const auto metallic = [](int i) { return static_cast<float>(i % 6) / 5.0f; };
    Material& m = scene.materials[0];
    m.lobe = Lobe::ggx;
    m.textures.diffuse =
        add_texture(scene, 6, 6, [&](int i) { return base(i) * (1.0f - metallic(i)); });
    m.textures.specular = add_texture(
        scene, 6, 6, [&](int i) { return glm::mix(Spectrum(0.04f), base(i), metallic(i)); });
    m.textures.roughness =
        add_texture(scene, 6, 6, [](int i) { return Spectrum(static_cast<float>(i) / 255.0f); });
    m.diffuse = mean_of(scene, m.textures.diffuse);
    m.specular = mean_of(scene, m.textures.specular);
    m.roughness = mean_of(scene, m.textures.roughness).r;
    Material& rough = scene.materials[1];
    rough.lobe = Lobe::ggx;
    rough.specular = Spectrum(0.3f);
    rough.textures.roughness = m.textures.roughness;
    rough.roughness = m.roughness;
    for (const char* name : {"x.gltf", "x.glb"})
        expect_same_materials(scene, save_and_load(scene, name), rounding, texel_rounding);
    EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];
}

TEST_F(SaveScene, WrappingIsKept) {
    Scene scene = two_objects({named("a")});
    Texture texture{.width = 2, .height = 1, .texels = {Spectrum(0.0f), Spectrum(1.0f)}};
    texture.wrap_u = texture.wrap_v = Texture::Wrap::clamp;
    Material& m = scene.materials[0];
    m.textures.diffuse = 0;
    scene.textures = {std::make_shared<const Texture>(texture)};
    expect_same_materials(scene, save_and_load(scene, "x.obj"), rounding);
    EXPECT_TRUE(monitor_.warnings.empty());
    texture.wrap_v = Texture::Wrap::mirrored;
    scene.textures = {std::make_shared<const Texture>(texture)};
    expect_same_materials(scene, save_and_load(scene, "x.glb"), rounding);
    EXPECT_TRUE(monitor_.warnings.empty());
    (void)save_and_load(scene, "y.obj");
    expect_warning("mirrored or mixed wrapping");
}

}  // namespace

}  // namespace transillum
