// What is written as OBJ is read back as it was, as far as the format can hold it.
#include "unit/scene/saved_scenes.h"

namespace transillum {

namespace {

using testing_support::expect_same_materials;
using testing_support::expect_same_polygons;

TEST_F(SaveScene, ObjKeepsAllToTheBit) {
    std::vector<Material> materials = lambert_materials();
    Material glossy = named("glossy");
    glossy.lobe = Lobe::max_phong;
    glossy.specular = {0.3f, 0.2f, 0.1f};
    glossy.shininess = 33.3f;
    materials.push_back(glossy);
    Scene scene = with_pentagon(two_objects(materials));
    scene.cameras = {camera_of("front"), camera_of("back")};
    const Scene read = save_and_load(scene, "room.obj");
    EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];
    EXPECT_EQ(scene.positions, read.positions);
    expect_same_polygons(scene, read);
    scene.materials[0].name = "red _ wall";
    expect_same_materials(scene, read, 0.0f);
    for (std::size_t i = 0; i < materials.size(); ++i)
        EXPECT_EQ(read.materials[i].name, scene.materials[i].name);
    ASSERT_EQ(read.cameras.size(), 2u);
    EXPECT_EQ(read.cameras[1].name, "back");
    EXPECT_EQ(read.cameras[1].eye, scene.cameras[1].eye);
    EXPECT_EQ(read.cameras[1].look_at, scene.cameras[1].look_at);
    EXPECT_EQ(read.cameras[1].up, scene.cameras[1].up);
    EXPECT_EQ(read.cameras[1].vertical_fov, scene.cameras[1].vertical_fov);
    EXPECT_EQ(listing(), (std::set<std::string>{"room.mtl", "room.obj"}));
}

TEST_F(SaveScene, ObjTellsMaterialsOfOneNameApart) {
    std::vector<Material> materials(4, named("wall"));
    for (int i = 0; i < 4; ++i) materials[i].diffuse = Spectrum(0.1f * static_cast<float>(i));
    materials[2].name = "wall-2";
    materials[3].name = "";
    const Scene scene = two_objects(materials);
    const Scene read = save_and_load(scene, "x.obj");
    expect_same_polygons(scene, read);
    expect_same_materials(scene, read, 0.0f);
    EXPECT_TRUE(RecordingMonitor::any_names(monitor_.notes, "2 materials are renamed"));
}

TEST_F(SaveScene, ObjTellsWhatItCannotHold) {
    std::vector<Material> materials{named("mirror"), named("lamp"), named("one side")};
    materials[0].lobe = Lobe::ggx;
    materials[0].specular = Spectrum(0.5f);
    materials[0].roughness = 0.5f;
    materials[1].emission = Spectrum(1.0f);
    materials[1].back_emits = true;
    materials[2].back_reflects = false;
    Scene scene = two_objects(materials);
    scene.objects.push_back("empty");
    scene.lighting.lights.resize(3);
    const Scene read = save_and_load(scene, "x.obj");
    EXPECT_EQ(monitor_.warnings.size(), 5u);
    expect_warning("1 material with a GGX lobe");
    expect_warning("1 material whose back emits");
    expect_warning("1 material with a black back");
    expect_warning("x.obj: OBJ holds no lights; 3 left out");
    expect_warning("1 left out");
    EXPECT_EQ(read.materials[0].lobe, Lobe::max_phong);
    EXPECT_FLOAT_EQ(read.materials[0].shininess, 2.0f / 0.0625f - 2.0f);
}

}  // namespace

}  // namespace transillum
