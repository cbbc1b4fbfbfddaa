#include "unit/scene/scene_files.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace transillum {

namespace {

using Json = nlohmann::json;

std::string triangle_buffer() {
    std::string bytes;
    for (const float v : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) bytes += bytes_of(v);
    for (std::uint16_t i = 0; i < 3; ++i) bytes += bytes_of(i);
    return bytes + std::string(2, '\0');
}

/// One triangle with one material, its buffer in the file "x.bin".
Json triangle() {
    return Json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "thing"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "m", "pbrMetallicRoughness": {"metallicFactor": 0}}],
        "buffers": [{"byteLength": 44, "uri": "x.bin"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})");
}

std::string chunk(std::uint32_t type, std::string bytes, char padding) {
    bytes.resize((bytes.size() + 3) / 4 * 4, padding);
    return bytes_of(static_cast<std::uint32_t>(bytes.size())) + bytes_of(type) + bytes;
}

std::string glb(Json document) {
    document["buffers"][0].erase("uri");
    const std::string chunks =
        chunk(0x4e4f534a, document.dump(), ' ') + chunk(0x004e4942, triangle_buffer(), '\0');
    return "glTF" + bytes_of(std::uint32_t{2}) +
           bytes_of(static_cast<std::uint32_t>(chunks.size() + 12)) + chunks;
}

class ReadGltf : public SceneFiles {
protected:
    ReadGltf() { write("x.bin", triangle_buffer()); }
    Scene load_json(const Json& document) { return load("x.gltf", document.dump()); }
    Material material_of(const std::string& json) {
        Json document = triangle();
        document["materials"][0] = Json::parse(json);
        return load_json(document).materials.at(0);
    }
    /// Expects the triangle, patched (RFC 6902 "replace"/"add" of one place), to be refused.
    void expect_patch_refused(const std::string& place, const Json& value,
                              const std::vector<std::string>& parts) {
        Json document = triangle();
        document[Json::json_pointer(place)] = value;
        expect_refused("x.gltf", document.dump(), parts);
    }
};

TEST_F(ReadGltf, ReadsATriangle) {
    const Scene scene = load_json(triangle());
    ASSERT_EQ(scene.polygons.size(), 1u);
    EXPECT_EQ(corners_of(scene, 0), (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene.objects, std::vector<std::string>{"thing"});
    EXPECT_EQ(scene.materials.at(0).diffuse, Spectrum(1.0f));
    EXPECT_TRUE(scene.uvs.empty());
}

TEST_F(ReadGltf, ReadsTheSameFromGlbAndEmbedded) {
    EXPECT_EQ(load("y.glb", glb(triangle())).positions, load_json(triangle()).positions);
    Json document = triangle();
    // the 44 bytes of triangle_buffer() in base64
    document["buffers"][0]["uri"] =
        "data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA=";
    const Scene embedded = load_json(document);
    EXPECT_EQ(embedded.positions, load_json(triangle()).positions);
    EXPECT_EQ(embedded.corners, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST_F(ReadGltf, PlacesNodesByTheirAncestors) {
    Json document = triangle();
    // turn by 90 degrees about z, after scaling by 2, then move by 10 along x
    const double h = std::sqrt(0.5);
    document["nodes"] = {{{"translation", {10, 0, 0}}, {"children", {1}}},
                         {{"rotation", {0, 0, h, h}}, {"scale", {2, 2, 2}}, {"mesh", 0}}};
    const std::vector<glm::dvec3> corners = corners_of(load_json(document), 0);
    const std::vector<glm::dvec3> expected{{10, 0, 0}, {10, 2, 0}, {8, 0, 0}};
    for (int i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(corners[i][axis], expected[i][axis], 1e-14);
}

TEST_F(ReadGltf, KeepsTheFrontOfMirroredNodes) {
    Json document = triangle();
    document["nodes"][0]["scale"] = {-1, 1, 1};
    EXPECT_EQ(corners_of(load_json(document), 0),
              (std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}));
}

TEST_F(ReadGltf, UnrollsStripsAndFans) {
    std::string bytes;
    for (const float v : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f})
        bytes += bytes_of(v);
    write("x.bin", bytes);
    Json document = triangle();
    document["buffers"][0]["byteLength"] = 48;
    document["bufferViews"][0]["byteLength"] = 48;
    document["accessors"][0]["count"] = 4;
    Json& primitive = document["meshes"][0]["primitives"][0];
    primitive.erase("indices");
    primitive["mode"] = 5;
    EXPECT_EQ(load_json(document).corners, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    primitive["mode"] = 6;
    EXPECT_EQ(load_json(document).corners, (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0}));
    primitive["mode"] = 4;
    expect_refused("x.gltf", document.dump(),
                   {"meshes[0]/primitives[0]", "4 indices; accepted: a multiple of 3"});
}

TEST_F(ReadGltf, ReadsMaterials) {
    const Material m =
        material_of(R"({"name": "m", "doubleSided": true, "emissiveFactor": [1, 0.5, 0.25],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}},
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 0.25, 1], "metallicFactor": 0.25, "roughnessFactor": 0.5}})");
    EXPECT_EQ(m.diffuse, Spectrum(0.375f, 0.75f, 0.1875f));
    EXPECT_EQ(m.lobe, Lobe::ggx);
    // a quarter metal, three quarters dielectric
    for (int c = 0; c < channel_count; ++c)
        EXPECT_FLOAT_EQ(m.specular[c], 0.25f * Spectrum(0.5f, 1.0f, 0.25f)[c] + 0.75f * 0.04f);
    EXPECT_EQ(m.roughness, 0.5f);
    EXPECT_EQ(m.emission, Spectrum(8.0f, 4.0f, 2.0f));
    EXPECT_TRUE(m.back_reflects);
    EXPECT_TRUE(m.back_emits);
}

TEST_F(ReadGltf, TakesAbsentFactorsAsTheSpecificationSays) {
    const Material m = material_of(R"({"name": "m"})");
    EXPECT_EQ(m.diffuse, Spectrum(0.0f)) << "metallic is 1";
    EXPECT_EQ(m.specular, Spectrum(1.0f));
    EXPECT_EQ(m.emission, Spectrum(0.0f));
    EXPECT_FALSE(m.back_reflects);
    EXPECT_FALSE(m.back_emits);
    Json document = triangle();
    document["meshes"][0]["primitives"][0].erase("material");
    const Scene scene = load_json(document);
    EXPECT_EQ(scene.materials.at(scene.polygons[0].material).specular, Spectrum(1.0f));
    EXPECT_EQ(scene.materials.at(scene.polygons[0].material).lobe, Lobe::ggx);
}

TEST_F(ReadGltf, TakesDielectricsAsTheirExtensionsSay) {
    const auto specular_of = [&](const std::string& extensions) {
        return material_of(R"({"name": "m", "pbrMetallicRoughness": {"metallicFactor": 0},
            "extensions": {)" +
                           extensions + "}}");
    };
    EXPECT_FLOAT_EQ(specular_of(R"("KHR_materials_ior": {"ior": 2})").specular.r, 1.0f / 9.0f);
    EXPECT_TRUE(monitor_.notes.empty());
    const Material m = specular_of(R"("KHR_materials_specular":
        {"specularFactor": 0.5, "specularColorFactor": [1, 0.5, 100]})");
    EXPECT_FLOAT_EQ(m.specular.r, 0.02f);
    EXPECT_FLOAT_EQ(m.specular.g, 0.01f);
    EXPECT_FLOAT_EQ(m.specular.b, 0.5f) << "the reflectance ends at 1 before the factor";
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "'m': specularFactor counts along the normal"));
}

TEST_F(ReadGltf, TakesASpecularFactorOfZeroForLambert) {
    const Material m = material_of(R"({"name": "m", "pbrMetallicRoughness": {"metallicFactor": 0},
            "extensions": {"KHR_materials_specular": {"specularFactor": 0}}})");
    EXPECT_EQ(m.lobe, Lobe::none);
    EXPECT_EQ(m.specular, Spectrum(0.0f));
    EXPECT_EQ(m.diffuse, Spectrum(1.0f));
}

TEST_F(ReadGltf, AcceptsEmissionAboveOneWithANote) {
    EXPECT_EQ(material_of(R"({"name": "m", "emissiveFactor": [10, 10, 10]})").emission,
              Spectrum(10.0f));
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "'m': emissiveFactor above the 1"));
}

TEST_F(ReadGltf, TakesAlphaForOpacityOnlyWhereItBlends) {
    const std::string base = R"("pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}})";
    EXPECT_EQ(material_of(R"({"alphaMode": "BLEND", )" + base).opacity, 0.25f);
    EXPECT_EQ(material_of("{" + base).opacity, 1.0f);
    EXPECT_EQ(material_of(R"({"alphaMode": "MASK", )" + base).opacity, 0.0f);
    EXPECT_EQ(material_of(R"({"alphaMode": "MASK", "alphaCutoff": 0.2, )" + base).opacity, 1.0f);
}

TEST_F(ReadGltf, ReadsCamerasWhereTheirNodesAre) {
    Json document = triangle();
    const double h = std::sqrt(0.5);
    document["scenes"][0]["nodes"] = {0, 1};
    document["nodes"].push_back(
        {{"translation", {1, 2, 3}}, {"rotation", {0, h, 0, h}}, {"camera", 0}, {"name", "seat"}});
    document["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", std::numbers::pi / 3}, {"znear", 1}}}}};
    const Camera camera = load_json(document).cameras.at(0);
    EXPECT_EQ(camera.name, "seat");
    EXPECT_EQ(camera.eye, glm::dvec3(1, 2, 3));
    EXPECT_NEAR(camera.vertical_fov, 60.0, 1e-12);
    // turned by 90 degrees about y, -z becomes -x
    EXPECT_NEAR(camera.look_at.x, 0.0, 1e-14);
    EXPECT_NEAR(camera.look_at.y, 2.0, 1e-14);
    EXPECT_NEAR(camera.look_at.z, 3.0, 1e-14);
    EXPECT_NEAR(camera.up.y, 1.0, 1e-14);
}

TEST_F(ReadGltf, RefusesWrongFactors) {
    expect_patch_refused("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 2, 1, 1},
                         {"materials[0] 'm'", "baseColorFactor has 2; accepted: 0 to 1"});
    expect_patch_refused("/materials/0/emissiveFactor", {0, 0, -1},
                         {"materials[0] 'm'", "emissiveFactor has -1"});
    expect_patch_refused("/materials/0/pbrMetallicRoughness/metallicFactor", 1.5,
                         {"metallicFactor has 1.5"});
    expect_patch_refused("/materials/0/extensions",
                         {{"KHR_materials_specular", {{"specularFactor", 2}}}},
                         {"specularFactor has 2; accepted: 0 to 1"});
    expect_patch_refused("/materials/0/extensions", {{"KHR_materials_ior", {{"ior", -1}}}},
                         {"ior has -1; accepted: 0 or more"});
    expect_patch_refused("/materials/0/emissiveFactor", {1, 1}, {"accepted: 3 numbers"});
    expect_patch_refused("/materials/0/alphaMode", "DITHER", {"alphaMode 'DITHER'"});
    expect_patch_refused("/materials/0/name", 7, {"x.gltf", "/materials/0/name"});
}

TEST_F(ReadGltf, RefusesWrongIndices) {
    expect_patch_refused("/nodes/0/mesh", 1,
                         {"meshes: element '1' is named of 1; accepted: 0 to 0"});
    expect_patch_refused("/nodes/0/mesh", -1, {"meshes: element '-1'"});
    expect_patch_refused("/scene", 3, {"scenes: element '3'"});
    expect_patch_refused("/scenes/0/nodes", {5}, {"nodes: element '5'"});
    expect_patch_refused("/meshes/0/primitives/0/material", 4, {"materials: element '4'"});
    expect_patch_refused("/meshes/0/primitives/0/indices", 9, {"accessors: element '9'"});
    expect_patch_refused("/bufferViews/0/buffer", 2, {"buffers: element '2'"});
    expect_patch_refused("/nodes/0/children", {0}, {"nodes[0]", "its own ancestor"});
    std::string bytes = triangle_buffer();
    bytes[36] = 3;
    write("x.bin", bytes);
    expect_refused("x.gltf", triangle().dump(),
                   {"meshes[0]/primitives[0]: face 0 names vertex 3 of 3; accepted: 0 to 2"});
}

TEST_F(ReadGltf, RefusesWhatReachesBeyondItsBuffer) {
    expect_patch_refused("/accessors/0/count", 4,
                         {"accessors[0]: 4 elements", "its bufferView has 36 bytes"});
    expect_patch_refused("/accessors/0/count", 18446744073709551615u, {"accessors[0]"});
    expect_patch_refused("/accessors/0/byteOffset", 40, {"accessors[0]"});
    expect_patch_refused("/bufferViews/0/byteStride", 4, {"accessors[0]"});
    expect_patch_refused("/bufferViews/1/byteOffset", 40,
                         {"bufferViews[1]: 6 bytes from 40 on; its buffer has 44"});
    expect_patch_refused("/bufferViews/1/byteOffset", 18446744073709551615u, {"bufferViews[1]"});
    expect_patch_refused("/buffers/0/byteLength", 4000000000u,
                         {"buffers[0]: says 4000000000 bytes, but there are 44"});
    expect_patch_refused("/buffers/0/uri", "gone.bin",
                         {"buffers[0]: its file", "gone.bin' is not there"});
    expect_patch_refused("/buffers/0/uri", "data:;base64,AAA*",
                         {"buffers[0]: base64 data with the character '*'"});
    expect_patch_refused("/accessors/0/sparse", Json::object(), {"accessors[0]: is sparse"});
    expect_patch_refused("/accessors/0/type", "VEC2",
                         {"accessors[0]: type 'VEC2'; accepted: VEC3"});
    write("x.bin", triangle_buffer().substr(0, 40));
    expect_refused("x.gltf", triangle().dump(), {"buffers[0]: says 44 bytes, but there are 40"});
}

TEST_F(ReadGltf, RefusesCoordinatesThatAreNotFinite) {
    std::string bytes = triangle_buffer();
    bytes.replace(4, 4, bytes_of(std::numeric_limits<float>::infinity()));
    write("x.bin", bytes);
    expect_refused("x.gltf", triangle().dump(),
                   {"meshes[0]/primitives[0]: vertex 0 has a coordinate that is not finite"});
}

TEST_F(ReadGltf, RefusesEveryBeginningOfAFile) {
    expect_no_beginning_loads("y.glb", glb(triangle()));
    expect_no_beginning_loads("x.gltf", triangle().dump());
}

TEST_F(ReadGltf, RefusesWhatIsNotGltf2) {
    expect_patch_refused("/asset/version", "1.0", {"glTF version '1.0'; accepted: 2.0"});
    expect_patch_refused("/extensionsRequired", {"KHR_draco_mesh_compression"},
                         {"'KHR_draco_mesh_compression' found"});
    expect_patch_refused("/meshes/0/primitives", Json::array(), {"no polygon found"});
    expect_refused("x.gltf", "[]", {"not a JSON object"});
    expect_refused("x.gltf", "hello", {"not JSON"});
}

TEST_F(ReadGltf, TakesTheFactorWhereAnImageIsMissing) {
    Json document = triangle();
    document["textures"] = {{{"source", 0}}};
    load_json(document);
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "textures[0] has an image that is not there"));
    document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    expect_refused("x.gltf", document.dump(), {"images: element '0' is named of 0"});
    document["images"] = {{{"uri", "gone%20away.png"}}};
    EXPECT_EQ(load_json(document).materials[0].diffuse, Spectrum(1.0f));
    EXPECT_TRUE(monitor_.any_names(monitor_.warnings, "materials[0] 'm': the image of its"));
    EXPECT_TRUE(monitor_.any_names(monitor_.warnings, "'gone%20away.png', is not there"));
    monitor_.warnings.clear();
    document["materials"].push_back({{"name", "plain"}});
    document["meshes"][0]["primitives"][0]["material"] = 1;
    load_json(document);
    EXPECT_TRUE(monitor_.warnings.empty());
}

TEST_F(ReadGltf, ReadsAnEmbeddedTexture) {
    Json document = triangle();
    document["textures"] = {{{"source", 0}}};
    // a PNG of one pixel: 255 0 255
    document["images"] = {
        {{"uri",
          "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4"
          "z/AfAAQAAf8iCjrwAAAAAElFTkSuQmCC"}}};
    document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    EXPECT_EQ(load_json(document).materials[0].diffuse, Spectrum(1.0f, 0.0f, 1.0f));
}

TEST_F(ReadGltf, ReportsWhatItDoesNotHonour) {
    Json document = triangle();
    document["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_emissive_strength"};
    document["animations"] = {Json::object()};
    load_json(document);
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "KHR_materials_clearcoat"));
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "animations"));
    EXPECT_FALSE(monitor_.any_names(monitor_.notes, "emissive_strength"));
}

}  // namespace

}  // namespace transillum
