// Files as others left them, read, written in every format that holds them, and read again.
#include "support/same_scene.h"
#include "unit/scene/scene_files.h"

#include <transillum/repair/triangulate_scene.h>
#include <transillum/scene/save_scene.h>

namespace transillum {

namespace {

using testing_support::Compared;
using testing_support::expect_same_materials;
using testing_support::expect_same_polygons;

const std::filesystem::path data = TRANSILLUM_TEST_DATA;

class RealDataSaved : public SceneFiles, public testing::WithParamInterface<const char*> {
protected:
    Scene save_and_load(const Scene& scene, const std::string& name) {
        save_scene(scene, folder_ / name, monitor_);
        return load_scene(folder_ / name, {}, monitor_);
    }
    bool has(Lobe lobe, const Scene& scene) const {
        return std::ranges::count(scene.materials, lobe, &Material::lobe) > 0;
    }
    bool has_one_sided(const Scene& scene) const {
        return std::ranges::any_of(scene.materials, [](const Material& m) {
            return !m.back_reflects || (m.emits() && m.back_emits);
        });
    }
    bool has_one_sided_lamps(const Scene& scene) const {
        return std::ranges::any_of(scene.materials, [](const Material& m) {
            return m.emits() && m.back_reflects && !m.back_emits;
        });
    }
};

TEST_P(RealDataSaved, AreReadAsTheyWereWritten) {
    if (!std::filesystem::exists(data / GetParam())) GTEST_SKIP() << "no " << data / GetParam();
    Scene scene = load_scene(data / GetParam(), {}, monitor_);
    const Compared geometry{.objects = false, .materials = false, .uvs = false};

    const Scene obj = save_and_load(scene, "x.obj");
    expect_same_polygons(scene, obj);
    EXPECT_EQ(scene.cameras.size(), obj.cameras.size());
    if (!has(Lobe::ggx, scene) && !has_one_sided(scene))
        expect_same_materials(scene, obj, 0.0f, 2e-5f);
    expect_same_polygons(scene, save_and_load(scene, "x.ply"), geometry);
    expect_same_polygons(scene, save_and_load(scene, "x.off"), geometry);

    triangulate_scene(scene);
    Compared floats = geometry;
    floats.floats = true;
    expect_same_polygons(scene, save_and_load(scene, "x.stl"), floats);
    for (const char* name : {"x.gltf", "x.glb"}) {
        const Scene gltf = save_and_load(scene, name);
        expect_same_polygons(scene, gltf, {.order = false, .floats = true});
        EXPECT_EQ(scene.cameras.size(), gltf.cameras.size());
        EXPECT_EQ(scene.lighting.lights.size(), gltf.lighting.lights.size());
        if (!has(Lobe::max_phong, scene) && !has_one_sided_lamps(scene))
            expect_same_materials(scene, gltf, 3e-7f, 3e-5f);
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, RealDataSaved,
    testing::Values("scenes/cornell-mcguire/CornellBox-Original.obj",
                    "scenes/cornell-mcguire/CornellBox-Mirror.obj",
                    "scenes/cornell-mcguire/CornellBox-Sphere.obj",
                    "scenes/cornell-mcguire/CornellBox-Water.obj",
                    "scenes/cornell-nvidia/cornellBox.gltf", "scenes/hospital/hospital.obj",
                    "scenes/classroom-mgf/classroom-mgf.obj", "scenes/office3/office3.obj",
                    "scenes/kitchen-lux/kitchen-lux.obj", "scenes/menger/mengerSponge3.glb",
                    "scenes/game-turbine/turbine.obj", "meshes/chair.off", "meshes/bathtub.obj",
                    "meshes/two-boxes-bad-self-union.ply", "meshes/conrod.stl",
                    "meshes/moebius.obj", "meshes/wallhole.obj", "meshes/zero_area_face.obj",
                    "meshes/degenerate_edge.obj", "meshes/soup.stl"),
    [](const auto& info) {
        std::string name = std::filesystem::path(info.param).stem().string();
        std::erase_if(name, [](char c) { return c == '-' || c == '_'; });
        return name;
    });

TEST(TriangulateScene, CutsPolygonsInTheirPlace) {
    Scene scene;
    scene.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5, 0}, {0, 2, 0}};
    scene.corners = {0, 1, 2, 0, 1, 2, 3, 4, 4, 3, 2, 0, 1, 0, 1};
    for (std::uint32_t c = 0; c < scene.corners.size(); ++c)
        scene.uvs.emplace_back(static_cast<float>(scene.corners[c]), 0.5f);
    scene.polygons = {{0, 3, 7, 1, 4}, {3, 5, 8, 2, 5}, {8, 3, 9, 3, 6}, {11, 4, 9, 3, 7}};
    const TriangulationReport report = triangulate_scene(scene);
    EXPECT_EQ(report.polygons, 2u);
    EXPECT_EQ(report.without_area, 1u);
    ASSERT_EQ(scene.polygons.size(), 5u);
    double area = 0.0;
    for (std::size_t i = 0; i < 5; ++i) {
        const Polygon& p = scene.polygons[i];
        ASSERT_EQ(p.corner_count, 3u);
        EXPECT_EQ(p.source_face, i == 0 ? 4u : i == 4 ? 6u : 5u);
        EXPECT_EQ(p.material, i == 0 ? 7u : i == 4 ? 9u : 8u);
        const auto corners = corners_of(scene, i);
        const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
        if (p.source_face == 5) area += 0.5 * (u.x * v.y - u.y * v.x);
        for (std::uint32_t c = 0; c < 3; ++c)
            EXPECT_EQ(scene.uvs[p.first_corner + c].x,
                      static_cast<float>(scene.corners[p.first_corner + c]));
    }
    EXPECT_DOUBLE_EQ(area, 2.5);  // 4 less the notch of base 2 and height 1.5
}

}  // namespace

}  // namespace transillum
