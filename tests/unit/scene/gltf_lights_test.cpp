#include "unit/scene/scene_files.h"

#include <nlohmann/json.hpp>

#include <glm/geometric.hpp>

#include <numbers>

namespace transillum {
namespace {

using Json = nlohmann::json;

/// A triangle, and a node with a light.
Json lit_triangle() {
    return Json::parse(R"({
        "asset": {"version": "2.0"},
        "extensionsRequired": ["KHR_lights_punctual"],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "spot", "name": "lamp", "color": [1, 0.5, 0.25], "intensity": 40,
             "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.5}},
            {"type": "point"},
            {"type": "directional", "intensity": 3}
        ]}},
        "nodes": [
            {"mesh": 0},
            {"translation": [1, 2, 3], "rotation": [0.7071067811865476, 0, 0, 0.7071067811865476],
             "scale": [5, 5, 5], "children": [2],
             "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"translation": [0, 0, 1], "extensions": {"KHR_lights_punctual": {"light": 1}}},
            {"name": "sun", "extensions": {"KHR_lights_punctual": {"light": 2}}}
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri":
            "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
    })");
}

class GltfLights : public SceneFiles {
protected:
    std::vector<PunctualLight> lights(const Json& json) {
        return load("x.gltf", json.dump()).lighting.lights;
    }
    void expect_patch_refused(const char* pointer, const Json& value,
                              const std::vector<std::string>& parts) {
        Json json = lit_triangle();
        json[Json::json_pointer(pointer)] = value;
        expect_refused("x.gltf", json.dump(), parts);
    }
};

TEST_F(GltfLights, AreReadWithTheirNodes) {
    const std::vector<PunctualLight> found = lights(lit_triangle());
    ASSERT_EQ(found.size(), 3u);
    const auto named = [&](const std::string& name) {
        return *std::ranges::find(found, name, &PunctualLight::name);
    };
    const PunctualLight spot = named("lamp");
    EXPECT_EQ(spot.kind, PunctualLight::Kind::spot);
    EXPECT_EQ(spot.intensity, Spectrum(40.0f, 20.0f, 10.0f));
    EXPECT_EQ(spot.position, glm::dvec3(1, 2, 3));
    // -z turned a quarter about x is +y; +y becomes +z; scale does not matter.
    EXPECT_LT(glm::length(spot.direction - glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_LT(glm::length(spot.up - glm::dvec3(0, 0, 1)), 1e-12);
    EXPECT_EQ(spot.inner_angle, 0.2);
    EXPECT_EQ(spot.outer_angle, 0.5);
    const PunctualLight sun = named("sun");
    EXPECT_EQ(sun.kind, PunctualLight::Kind::directional);
    EXPECT_EQ(sun.intensity, Spectrum(3.0f));
    EXPECT_EQ(sun.direction, glm::dvec3(0, 0, -1));
    const auto point = std::ranges::find(found, PunctualLight::Kind::point, &PunctualLight::kind);
    EXPECT_EQ(point->intensity, Spectrum(1.0f));
    EXPECT_LT(glm::length(point->position - glm::dvec3(1, -3, 3)), 1e-12);
    EXPECT_TRUE(monitor_.notes.empty());
}

TEST_F(GltfLights, HaveTheDefaultsOfTheExtension) {
    Json json = lit_triangle();
    json["extensions"]["KHR_lights_punctual"]["lights"][0] = {{"type", "spot"}, {"range", 10}};
    const PunctualLight spot = lights(json).at(0).kind == PunctualLight::Kind::spot
                                   ? lights(json).at(0)
                                   : lights(json).at(1);
    EXPECT_EQ(spot.inner_angle, 0.0);
    EXPECT_EQ(spot.outer_angle, std::numbers::pi / 4.0);
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "not honoured: range of light"));
}

TEST_F(GltfLights, RefusesWhatIsOutOfRange) {
    const std::string lights = "/extensions/KHR_lights_punctual/lights/";
    expect_patch_refused((lights + "1/type").c_str(), "ambient",
                         {"KHR_lights_punctual lights[1]: type 'ambient'; accepted: point, spot"});
    expect_patch_refused((lights + "2/intensity").c_str(), -1.0,
                         {"lights[2]: intensity times color is -1; accepted: 0 or more"});
    expect_patch_refused((lights + "2/intensity").c_str(), 1e300, {"lights[2]: intensity"});
    expect_patch_refused((lights + "0/spot/innerConeAngle").c_str(), 0.5,
                         {"cone angles 0.5 and 0.5"});
    expect_patch_refused((lights + "0/spot/outerConeAngle").c_str(), 2.0,
                         {"cone angles 0.2 and 2"});
    expect_patch_refused("/nodes/3/extensions/KHR_lights_punctual/light", 3,
                         {"element '3' is named of 3; accepted: 0 to 2"});
    expect_patch_refused("/nodes/3/extensions/KHR_lights_punctual/light", "a", {"element"});
    expect_patch_refused("/nodes/3/scale", {1, 1, 0}, {"nodes[3]: its light has no direction"});
    expect_patch_refused("/extensions", Json::object(), {"is named of 0; accepted: none"});
}

}  // namespace
}  // namespace transillum
