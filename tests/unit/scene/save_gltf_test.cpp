// What is written as glTF is read back as it was, as far as the format can hold it.
#include "unit/scene/saved_scenes.h"

#include <glm/geometric.hpp>

namespace transillum {

namespace {

using testing_support::expect_same_materials;
using testing_support::expect_same_polygons;

std::vector<Material> gltf_materials() {
    std::vector<Material> materials = lambert_materials();
    Material plastic = named("plastic"), metal = named("metal"), mixed = named("mixed"),
             odd = named("odd"), one_sided = named("one-sided"), both = named("both sides");
    for (Material* m : {&plastic, &metal, &mixed, &odd}) m->lobe = Lobe::ggx;
    plastic.specular = Spectrum(0.04f);
    plastic.roughness = 0.3f;
    metal.diffuse = Spectrum(0.0f);
    metal.specular = {1.0f, 0.7f, 1.0f / 3.0f};
    metal.roughness = 0.1f;
    mixed.diffuse = Spectrum(0.6f, 0.3f, 0.1f) * 0.25f;
    mixed.specular = Spectrum(0.04f * 0.25f) + 0.75f * Spectrum(0.6f, 0.3f, 0.1f);
    odd.specular = {0.2f, 0.01f, 0.05f};
    one_sided.back_reflects = false;
    both.emission = Spectrum(3.0f);
    both.back_emits = true;
    materials[1].back_reflects = false;  // a lamp of one side
    for (const Material& m : {plastic, metal, mixed, odd, one_sided, both}) materials.push_back(m);
    return materials;
}

class SaveGltf : public SaveScene, public testing::WithParamInterface<const char*> {
protected:
    const std::string name_ = std::string("room 1.") + GetParam();
};

INSTANTIATE_TEST_SUITE_P(All, SaveGltf, testing::Values("gltf", "glb"));

TEST_P(SaveGltf, KeepsTrianglesAndMaterials) {
    Scene scene = two_objects(gltf_materials());
    // Not in place: g++ 12 leaves the last ones of such a loop unrounded at -O3.
    std::vector<glm::vec3> rounded(scene.positions.begin(), scene.positions.end());
    scene.positions.assign(rounded.begin(), rounded.end());
    const Scene read = save_and_load(scene, name_);
    EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];
    EXPECT_TRUE(monitor_.notes.empty()) << monitor_.notes[0];
    expect_same_polygons(scene, read, {.order = false});
    expect_same_materials(scene, read, rounding);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        EXPECT_EQ(read.materials[i].name, scene.materials[i].name);
    EXPECT_EQ(listing(), std::string(GetParam()) == "glb"
                             ? (std::set<std::string>{"room 1.glb"})
                             : (std::set<std::string>{"room 1.gltf", "room_1.bin"}));
}

TEST_P(SaveGltf, RoundsAndTellsHowFar) {
    const Scene scene = two_objects(gltf_materials());
    const Scene read = save_and_load(scene, name_);
    expect_same_polygons(scene, read, {.order = false, .floats = true});
    ASSERT_EQ(monitor_.notes.size(), 1u);
    EXPECT_NE(monitor_.notes[0].find("moved by up to "), std::string::npos);
}

TEST_P(SaveGltf, KeepsCamerasAndLights) {
    Scene scene = two_objects(gltf_materials());
    scene.cameras = {camera_of("the front")};
    using Kind = PunctualLight::Kind;
    PunctualLight point, spot, sun;
    point.name = "bulb";
    point.position = {0.1, 2.0 / 3.0, 7.0};
    spot.name = "spot";
    spot.kind = Kind::spot;
    sun.name = "sun";
    sun.kind = Kind::directional;
    point.intensity = {1.0f / 3.0f, 0.7f, 123.4f};
    spot.direction = glm::normalize(glm::dvec3(1, -2, 0.5));
    spot.inner_angle = 0.1;
    spot.outer_angle = 0.3;
    sun.direction = {0.0, -1.0, 0.0};  // along `up`
    sun.intensity = Spectrum(0.0f);
    scene.lighting.lights = {point, spot, sun};
    const Scene read = save_and_load(scene, name_);
    EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];

    ASSERT_EQ(read.cameras.size(), 1u);
    const Camera &a = scene.cameras[0], &b = read.cameras[0];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.eye, b.eye);
    EXPECT_NEAR(a.vertical_fov, b.vertical_fov, 1e-13);
    const auto forward = [](const Camera& c) { return glm::normalize(c.look_at - c.eye); };
    const auto right = [&](const Camera& c) {
        return glm::normalize(glm::cross(forward(c), c.up));
    };
    EXPECT_LT(glm::distance(forward(a), forward(b)), 1e-14);
    EXPECT_LT(glm::distance(right(a), right(b)), 1e-14);

    ASSERT_EQ(read.lighting.lights.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const PunctualLight &x = scene.lighting.lights[i], &y = read.lighting.lights[i];
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(x.kind, y.kind);
        EXPECT_EQ(x.intensity, y.intensity);
        EXPECT_EQ(x.position, y.position);
        EXPECT_LT(glm::distance(x.direction, y.direction), 1e-15);
    }
    EXPECT_EQ(read.lighting.lights[1].inner_angle, 0.1);
    EXPECT_EQ(read.lighting.lights[1].outer_angle, 0.3);
}

TEST_P(SaveGltf, RefusesPolygons) {
    const Scene scene = with_pentagon(two_objects({named("m")}));
    try {
        save_scene(scene, folder_ / name_, monitor_);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "made: face 2 has 5 corners; accepted by glTF: 3");
    }
    EXPECT_TRUE(listing().empty());
}

}  // namespace

}  // namespace transillum
