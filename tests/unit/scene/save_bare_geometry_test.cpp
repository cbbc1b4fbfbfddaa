// What is written as PLY, OFF or STL is read back as it was, as far as the format can hold it.
#include "unit/scene/saved_scenes.h"

#include <cmath>

namespace transillum {

namespace {

using testing_support::expect_same_polygons;

TEST_F(SaveScene, PlyAndOffKeepPolygonsToTheBit) {
    Scene scene = with_pentagon(two_objects({named("default")}));
    scene.objects.pop_back();
    for (Polygon& p : scene.polygons) p.object = 0;
    scene.uvs.clear();
    for (const char* name : {"x.ply", "x.off"}) {
        const Scene read = save_and_load(scene, name);
        EXPECT_EQ(scene.positions, read.positions);
        EXPECT_EQ(scene.corners, read.corners);
        expect_same_polygons(scene, read, {.objects = false});
    }
    EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];
    EXPECT_TRUE(monitor_.notes.empty());
}

TEST_F(SaveScene, PlyKeepsPolygonsOfManyCorners) {
    Scene scene = two_objects({named("default")});
    std::vector<Corner> circle;
    for (int i = 0; i < 300; ++i) circle.push_back({{std::cos(i / 50.0), std::sin(i / 50.0), 0}});
    add_polygon(scene, circle, 0, 1);
    expect_same_polygons(scene, save_and_load(scene, "x.ply"),
                         {.objects = false, .uvs = false, .order = false});
}

TEST_F(SaveScene, StlKeepsTrianglesOfFloats) {
    const Scene scene = two_objects({named("default")});
    const Scene read = save_and_load(scene, "x.stl");
    expect_same_polygons(scene, read,
                         {.objects = false, .uvs = false, .order = false, .floats = true});
    // 1e10 / 3 has steps of 256.
    ASSERT_EQ(monitor_.notes.size(), 1u);
    EXPECT_NE(monitor_.notes[0].find("moved by up to "), std::string::npos);
    const double told = std::stod(monitor_.notes[0].substr(monitor_.notes[0].rfind(' ')));
    EXPECT_GT(told, 0.0);
    EXPECT_LE(told, 128.0);
    expect_same_polygons(read, save_and_load(read, "y.stl"), {.objects = false});
    EXPECT_EQ(monitor_.notes.size(), 1u);
}

TEST_F(SaveScene, BareGeometryTellsWhatIsLeftOut) {
    Scene scene = two_objects(lambert_materials());
    scene.cameras = {camera_of("front")};
    scene.lighting.lights.resize(2);
    scene.lighting.environment.kind = Environment::Kind::uniform;
    for (const char* name : {"x.ply", "x.off", "x.stl"}) {
        monitor_.warnings.clear();
        (void)save_and_load(scene, name);
        EXPECT_EQ(monitor_.warnings.size(), 6u);
        expect_warning("holds no materials; 3 left out");
        expect_warning("holds no texture coordinates; 18 left out");
        expect_warning("holds no objects; 2 left out");
        expect_warning("holds no cameras; 1 left out");
        expect_warning("holds no lights; 2 left out");
        expect_warning("holds no environment; 1 left out");
    }
}

}  // namespace

}  // namespace transillum
