// Where scenes are written to, and what is left where that fails.
#include "unit/scene/saved_scenes.h"

#include <limits>

namespace transillum {

namespace {

using testing_support::expect_same_materials;
using testing_support::expect_same_polygons;

TEST_F(SaveScene, UnknownExtensionsAreRefused) {
    const Scene scene = two_objects({named("m")});
    for (const char* name : {"x.fbx", "x", "x.OBJ.zip"}) {
        try {
            save_scene(scene, folder_ / name, monitor_);
            ADD_FAILURE() << name;
        } catch (const UsageError& error) {
            EXPECT_NE(std::string(error.what()).find("accepted: .gltf .glb .obj .ply .stl .off"),
                      std::string::npos);
        }
    }
    EXPECT_TRUE(holds_polygons("x.OBJ") && holds_polygons("x.ply") && holds_polygons("x.off"));
    EXPECT_FALSE(holds_polygons("x.stl") || holds_polygons("x.gltf") || holds_polygons("x.Glb"));
    EXPECT_TRUE(listing().empty());
}

TEST_F(SaveScene, WhatFailsLeavesAllAsItWas) {
    Scene scene = two_objects({named("m")});
    (void)write("x.obj", "old");
    std::filesystem::create_directory(folder_ / "x.mtl");
    EXPECT_THROW(save_scene(scene, folder_ / "x.obj", monitor_), IoError);
    EXPECT_EQ(std::filesystem::file_size(folder_ / "x.obj"), 3u);
    EXPECT_EQ(listing(), (std::set<std::string>{"x.mtl", "x.obj"}));
    std::filesystem::create_directory(folder_ / "y.obj");
    EXPECT_THROW(save_scene(scene, folder_ / "y.obj", monitor_), IoError);
    EXPECT_EQ(listing(), (std::set<std::string>{"x.mtl", "x.obj", "y.obj"}));
    EXPECT_THROW(save_scene(scene, folder_ / "none/x.obj", monitor_), IoError);
    scene.positions[0].x = 1e300;
    EXPECT_THROW(save_scene(scene, folder_ / "x.stl", monitor_), InputError);
    scene.polygons.clear();
    EXPECT_THROW(save_scene(scene, folder_ / "x.ply", monitor_), InputError);
    EXPECT_EQ(listing(), (std::set<std::string>{"x.mtl", "x.obj", "y.obj"}));
}

TEST_F(SaveScene, FormatsOfFloatsRefuseWhatIsNoFiniteNumber) {
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()})
        for (const char* name : {"x.stl", "x.gltf", "x.glb"}) {
            Scene scene = two_objects({named("m")});
            scene.positions[1].y = value;
            try {
                save_scene(scene, folder_ / name, monitor_);
                ADD_FAILURE() << name;
            } catch (const InputError& error) {
                EXPECT_STREQ(error.what(),
                             "made: vertex 1 has a coordinate that is no finite number; accepted: "
                             "finite ones");
            }
        }
    EXPECT_TRUE(listing().empty());
}

TEST_F(SaveScene, ReplacesWhatWasThere) {
    const Scene scene = two_objects(lambert_materials());
    (void)write("x.obj", "old");
    (void)write("x.mtl", "old");
    expect_same_polygons(scene, save_and_load(scene, "x.obj"));
    EXPECT_EQ(listing(), (std::set<std::string>{"x.mtl", "x.obj"}));
}

/// Names with blanks and signs that mean something in one of the formats.
TEST_F(SaveScene, FilesMayHaveAnyName) {
    Scene scene = two_objects({named("m")});
    scene.materials[0].textures.diffuse =
        add_texture(scene, 2, 1, [](int i) { return Spectrum(of_8_bits(255 * i)); });
    scene.materials[0].diffuse = Spectrum(0.5f);
    for (const char* stem : {"-s 1", "a#b %41", "#x", "a\\b", "\xc3\xa4"})
        for (const char* extension : {".obj", ".gltf", ".glb"})
            expect_same_materials(scene, save_and_load(scene, std::string(stem) + extension),
                                  rounding);
}

}  // namespace

}  // namespace transillum
