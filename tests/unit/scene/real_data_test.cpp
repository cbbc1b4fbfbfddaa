// Files as others left them, where they are at hand.
#include "unit/scene/scene_files.h"

#include <cmath>

namespace transillum {

namespace {

const std::filesystem::path data = TRANSILLUM_TEST_DATA;

struct SceneCounts {
    const char* file;
    std::size_t polygons, triangles, emitting, materials, cameras;  ///< emitting: triangles
    std::string first_warning;
};

void PrintTo(const SceneCounts& c, std::ostream* out) {
    *out << c.file;
}

class RealDataScene : public testing::TestWithParam<SceneCounts> {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(data / "scenes")) GTEST_SKIP() << "no scenes in " << data;
    }
};

TEST_P(RealDataScene, HasTheCountsThatAreKnown) {
    const SceneCounts& expected = GetParam();
    RecordingMonitor monitor;
    const Scene scene = load_scene(data / "scenes" / expected.file, {}, monitor);
    std::size_t triangles = 0, emitting = 0;
    for (const Polygon& p : scene.polygons) {
        triangles += p.corner_count - 2;
        if (scene.materials[p.material].emits()) emitting += p.corner_count - 2;
    }
    EXPECT_EQ(scene.polygons.size(), expected.polygons);
    EXPECT_EQ(triangles, expected.triangles);
    EXPECT_EQ(emitting, expected.emitting);
    EXPECT_EQ(scene.materials.size(), expected.materials);
    EXPECT_EQ(scene.cameras.size(), expected.cameras);
    if (expected.first_warning.empty()) {
        EXPECT_TRUE(monitor.warnings.empty()) << monitor.warnings[0];
    } else {
        EXPECT_TRUE(RecordingMonitor::any_names(monitor.warnings, expected.first_warning));
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, RealDataScene,
    testing::Values(SceneCounts{"cornell-mcguire/CornellBox-Original.obj", 18, 36, 2, 8, 0, ""},
                    SceneCounts{"cornell-mcguire/CornellBox-Mirror.obj", 18, 36, 2, 8, 0, ""},
                    SceneCounts{"cornell-mcguire/CornellBox-Sphere.obj", 2188, 2188, 2, 8, 0, ""},
                    SceneCounts{"cornell-mcguire/CornellBox-Water.obj", 7088, 7088, 2, 9, 0, ""},
                    SceneCounts{"cornell-nvidia/cornellBox.gltf", 16732, 16732, 12, 9, 1,
                                "sphere_instance_material"},
                    SceneCounts{"hospital/hospital.obj", 11215, 21116, 56, 38, 0, ""},
                    SceneCounts{"classroom-mgf/classroom-mgf.obj", 5250, 9253, 48, 26, 0, ""},
                    SceneCounts{"office3/office3.obj", 12298, 22406, 228, 31, 0, ""},
                    SceneCounts{"kitchen-lux/kitchen-lux.obj", 86032, 86032, 2, 26, 0, ""},
                    SceneCounts{"menger/mengerSponge3.glb", 21598, 21598, 0, 1, 0, ""}));

TEST(RealDataScenes, KeepWhatTheirFilesSay) {
    if (!std::filesystem::exists(data / "scenes")) GTEST_SKIP() << "no scenes in " << data;
    RecordingMonitor monitor;
    const Scene scene = load_scene(data / "scenes/cornell-nvidia/cornellBox.gltf", {}, monitor);
    // camera node: (0 0 19.99) -> (0 0 0), Y, 41.11 degrees
    EXPECT_NEAR(scene.cameras.at(0).eye.z, 19.992, 1e-3);
    EXPECT_NEAR(scene.cameras.at(0).vertical_fov, 41.11, 5e-3);
    EXPECT_LT(scene.cameras.at(0).look_at.z, scene.cameras.at(0).eye.z);
    glm::dvec3 low(1e9), high(-1e9);
    for (const glm::dvec3& p : scene.positions) low = glm::min(low, p), high = glm::max(high, p);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(low[axis], -5.05, 1e-6);
    EXPECT_NEAR(high.z, 5.0, 1e-6);
    EXPECT_TRUE(RecordingMonitor::any_names(monitor.notes, "textures[0]"));
    EXPECT_TRUE(RecordingMonitor::any_names(monitor.notes, "NV_materials_mdl"));
    EXPECT_TRUE(RecordingMonitor::any_names(monitor.notes, "emissiveFactor above"));
}

TEST(RealDataScenes, LoadATurbineWithoutItsTextures) {
    if (!std::filesystem::exists(data / "scenes")) GTEST_SKIP() << "no scenes in " << data;
    RecordingMonitor monitor;
    const Scene scene = load_scene(data / "scenes/game-turbine/turbine.obj", {}, monitor);
    EXPECT_EQ(monitor.warnings.size(), 10u);
    EXPECT_TRUE(RecordingMonitor::any_names(monitor.warnings,
                                            "step01.png' is not there; 0.5 0.5 0.5 is taken"));
    for (const Material& m : scene.materials) EXPECT_EQ(m.diffuse, Spectrum(0.5f)) << m.name;
}

struct MeshCounts {
    const char* file;
    std::size_t triangles, polygons;
};

void PrintTo(const MeshCounts& c, std::ostream* out) {
    *out << c.file;
}

class RealDataMesh : public testing::TestWithParam<MeshCounts> {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(data / "meshes")) GTEST_SKIP() << "no meshes in " << data;
    }
};

TEST_P(RealDataMesh, HasTheCountsThatAreKnown) {
    RecordingMonitor monitor;
    const Scene scene = load_scene(data / "meshes" / GetParam().file, {}, monitor);
    std::size_t triangles = 0;
    for (const Polygon& p : scene.polygons) triangles += p.corner_count - 2;
    EXPECT_EQ(triangles, GetParam().triangles);
    EXPECT_EQ(scene.polygons.size(), GetParam().polygons);
}

INSTANTIATE_TEST_SUITE_P(
    All, RealDataMesh,
    testing::Values(
        MeshCounts{"chair.off", 1804, 1804}, MeshCounts{"table.off", 12500, 12500},
        MeshCounts{"bathtub.obj", 4375, 4375}, MeshCounts{"chair_model.obj", 12756, 12756},
        MeshCounts{"truck.obj", 4770, 4770}, MeshCounts{"two-boxes-bad-self-union.ply", 708, 708},
        MeshCounts{"conrod.stl", 6442, 6442}, MeshCounts{"boeing.off", 2564, 2564},
        MeshCounts{"pig.stl", 16848, 16848}, MeshCounts{"cube-shuffled.off", 12, 12},
        MeshCounts{"blobby-shuffled.off", 4050, 4050}, MeshCounts{"40509.stl", 14370, 14370},
        MeshCounts{"degenerate_edge.obj", 2, 2}, MeshCounts{"zero_area_face.obj", 1, 1},
        MeshCounts{"double_sided.obj", 4, 4}, MeshCounts{"moebius.obj", 448, 224},
        MeshCounts{"soup.stl", 100, 100}, MeshCounts{"wallhole.obj", 66, 13},
        MeshCounts{"clean/65004.stl", 1466, 1466}, MeshCounts{"clean/72214.stl", 1660, 1660}));

TEST(RealDataBroken, AreAllRefusedWithOneLineThatNamesThePlace) {
    if (!std::filesystem::exists(data / "meshes/broken")) GTEST_SKIP() << "no meshes in " << data;
    const std::vector<std::pair<std::string, std::string>> expected{
        {"truncated.obj", "truncated.obj:9: "},
        {"truncated.ply", "truncated.ply: vertex 6: the file ends too early"},
        {"truncated.stl", "the header says 20 facets"},
        {"corrupted_invalid_facet_vertex.obj",
         ".obj:20: face names vertex 8 of 6; accepted: 1 to 6 or -6 to -1"},
        {"corrupted_invalid_double.obj", ".obj:6: 'XXX0.5854098561465024'"},
        {"corrupted_invalid_facet_vertex.off",
         ".off:15: face names vertex 100 of 12; accepted: 0 to 11"},
        {"corrupted_invalid_vertex_count.ply", "corrupted_invalid_vertex_count.ply: "},
        {"corrupted_invalid_triangle_count.stl", "the header says 22 facets"},
        {"unparseable.stl", "unparseable.stl:4: "}};
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data / "meshes/broken")) {
        RecordingMonitor monitor;
        ++files;
        try {
            (void)load_scene(entry.path(), {}, monitor);
            ADD_FAILURE() << entry.path() << " was accepted";
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            for (const auto& [file, part] : expected) {
                if (entry.path().filename() != file) continue;
                EXPECT_NE(message.find(part), std::string::npos) << message;
            }
        }
    }
    EXPECT_EQ(files, expected.size());
}

}  // namespace

}  // namespace transillum
