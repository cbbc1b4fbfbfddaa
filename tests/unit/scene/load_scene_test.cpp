#include "unit/scene/scene_files.h"

namespace transillum {

namespace {

const std::string glass_and_wood =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl glass\nf 1 2 3\nusemtl wood\nf 1 2 3\n";

class LoadScene : public SceneFiles {
protected:
    LoadScene() {
        write("m.mtl",
              "newmtl glass\nKd 0 0 0\nd 0.5\nnewmtl wood\nKd 0.5 0.5 0.5\nnewmtl unused\nKd 0 0 "
              "0\nd 0\n");
    }
};

TEST_F(LoadScene, RefusesAFileThatIsNotThereOrEmptyOrUnknown) {
    for (const std::string name :
         {"none.obj", "none.gltf", "none.glb", "none.ply", "none.stl", "none.off"}) {
        EXPECT_THROW(load_scene(folder_ / name, {}, monitor_), IoError);
        expect_refused(name, "", {name + ": the file is empty"});
    }
    EXPECT_THROW(load_scene(folder_, {}, monitor_), InputError);
    std::filesystem::create_directory(folder_ / "folder.obj");
    EXPECT_THROW(load_scene(folder_ / "folder.obj", {}, monitor_), IoError);
    expect_refused("x.fbx", "data",
                   {"x.fbx: extension '.fbx'; accepted: .gltf .glb .obj .ply .stl .off"});
}

TEST_F(LoadScene, KnowsExtensionsInCapitals) {
    EXPECT_EQ(load("X.OBJ", glass_and_wood).polygons.size(), 2u);
}

TEST_F(LoadScene, OverridesSides) {
    const Scene file = load("x.obj", glass_and_wood);
    EXPECT_TRUE(file.materials[0].back_reflects);
    EXPECT_FALSE(file.materials[0].back_emits);
    const Scene one = load("x.obj", glass_and_wood, {.sides = Sides::one});
    EXPECT_FALSE(one.materials[0].back_reflects);
    EXPECT_FALSE(one.materials[0].back_emits);
    const Scene two = load("x.obj", glass_and_wood, {.sides = Sides::two});
    EXPECT_TRUE(two.materials[0].back_reflects);
    EXPECT_TRUE(two.materials[0].back_emits);
}

TEST_F(LoadScene, WarnsOfTransparencyOnceForEachMaterialUsed) {
    EXPECT_EQ(load("x.obj", glass_and_wood).polygons.size(), 2u);
    ASSERT_EQ(monitor_.warnings.size(), 1u);
    EXPECT_NE(monitor_.warnings[0].find("material 'glass' is transparent"), std::string::npos);
}

TEST_F(LoadScene, DropsTransparentPolygonsWhenAsked) {
    const Scene scene = load("x.obj", glass_and_wood, {.drop_transparent = true});
    ASSERT_EQ(scene.polygons.size(), 1u);
    EXPECT_EQ(scene.polygons[0].source_face, 1u) << "numbers stay those of the file";
    EXPECT_EQ(scene.materials.at(scene.polygons[0].material).name, "wood");
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "material 'glass'"));
    EXPECT_THROW(load("y.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl glass\nf 1 2 3\n",
                      {.drop_transparent = true}),
                 InputError);
}

}  // namespace

}  // namespace transillum
