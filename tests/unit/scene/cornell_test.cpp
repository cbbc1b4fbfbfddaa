// The scene that comes with the project.
#include "unit/scene/scene_files.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <map>

namespace transillum {

namespace {

class Cornell : public testing::Test {
protected:
    RecordingMonitor monitor_;
    const Scene scene_ =
        load_scene(TRANSILLUM_SOURCE_DIR "/data/scenes/cornell.gltf", {}, monitor_);

    glm::dvec3 area_vector(std::size_t polygon) const {
        const auto c = corners_of(scene_, polygon);
        return 0.5 * glm::cross(c[1] - c[0], c[2] - c[0]);
    }
};

TEST_F(Cornell, LoadsWithoutAWord) {
    EXPECT_EQ(scene_.polygons.size(), 32u);
    EXPECT_EQ(scene_.materials.size(), 4u);
    EXPECT_EQ(scene_.objects.size(), 8u);
    EXPECT_TRUE(monitor_.warnings.empty());
    EXPECT_TRUE(monitor_.notes.empty());
}

TEST_F(Cornell, IsLambertThroughout) {
    for (const Material& m : scene_.materials) EXPECT_EQ(m.lobe, Lobe::none) << m.name;
}

TEST_F(Cornell, HasALightThatShinesDown) {
    double area = 0.0;
    for (std::size_t p = 0; p < scene_.polygons.size(); ++p) {
        const Material& m = scene_.materials[scene_.polygons[p].material];
        EXPECT_EQ(m.back_reflects, !m.emits());
        if (!m.emits()) continue;
        EXPECT_EQ(scene_.objects[scene_.polygons[p].object], "light");
        EXPECT_EQ(m.emission, Spectrum(17.0f, 12.0f, 4.0f));
        EXPECT_LT(area_vector(p).y, 0.0);
        area += glm::length(area_vector(p));
    }
    EXPECT_DOUBLE_EQ(area, 130.0 * 105.0);
}

TEST_F(Cornell, FacesTheRoomFromEveryWall) {
    const glm::dvec3 middle(278, 274, 280);
    for (std::size_t p = 0; p < scene_.polygons.size(); ++p) {
        if (scene_.objects[scene_.polygons[p].object].ends_with("block")) continue;
        EXPECT_GT(glm::dot(area_vector(p), middle - corners_of(scene_, p)[0]), 0.0) << p;
    }
}

TEST_F(Cornell, ClosesItsBlocksButForTheBottom) {
    std::map<std::string, glm::dvec3> sum;
    for (std::size_t p = 0; p < scene_.polygons.size(); ++p)
        sum[scene_.objects[scene_.polygons[p].object]] += area_vector(p);
    // What is missing of a closed surface is its bottom, which faces down.
    for (const char* block : {"short block", "tall block"}) {
        EXPECT_NEAR(sum[block].x, 0.0, 1e-6);
        EXPECT_NEAR(sum[block].z, 0.0, 1e-6);
    }
    // shoelace formula on the tops' outlines
    EXPECT_NEAR(sum["short block"].y, 27633.0, 1e-6);
    EXPECT_NEAR(sum["tall block"].y, 27626.5, 1e-6);
}

TEST_F(Cornell, HasTheMeasuredCamera) {
    ASSERT_EQ(scene_.cameras.size(), 2u);
    EXPECT_EQ(scene_.cameras[0].name, "front");
    EXPECT_EQ(scene_.cameras[0].eye, glm::dvec3(278, 273, -800));
    EXPECT_EQ(scene_.cameras[0].look_at, glm::dvec3(278, 273, -799));
    EXPECT_EQ(scene_.cameras[0].up, glm::dvec3(0, 1, 0));
    // focal length 35, film 25 high
    EXPECT_NEAR(scene_.cameras[0].vertical_fov, glm::degrees(2.0 * std::atan(12.5 / 35.0)), 1e-12);
    EXPECT_EQ(scene_.cameras[1].name, "corner");
}

}  // namespace

}  // namespace transillum
