/// Textures as glTF and OBJ files name them.
#include "unit/scene/image_files.h"
#include "unit/scene/scene_files.h"

#include <nlohmann/json.hpp>

namespace transillum {

namespace {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;
using Floats = std::vector<float>;

constexpr float rounding = 1e-6f;

void expect_near(const Spectrum& a, const Spectrum& b, float tolerance = rounding) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

class SceneTextures : public SceneFiles {
protected:
    template <class Value>
    void image(const std::string& name, const ImageShape& shape, const std::vector<Value>& values) {
        write_image(folder_ / name, shape, values);
    }
    static const Texture& texture(const Scene& scene, std::int32_t index) {
        return *scene.textures.at(static_cast<std::size_t>(index));
    }
    bool warned(const std::string& part) const {
        return RecordingMonitor::any_names(monitor_.warnings, part);
    }
};

class GltfSceneTextures : public SceneTextures {
protected:
    /// A triangle with two sets of texture coordinates; images a.png, b.png and c.png, a texture
    /// each. Material 0 is `material`.
    Json document(const std::string& material) {
        std::string bytes;
        for (const float v : {0.f,  0.f,  0.f, 1.f,  0.f,  0.f, 0.f, 1.f, 0.f,  //
                              0.f,  0.f,  1.f, 0.f,  0.f,  1.f,                 //
                              0.5f, 0.5f, 1.f, 0.5f, 0.5f, 1.f})
            bytes += bytes_of(v);
        write("x.bin", bytes);
        Json json = Json::parse(R"({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1,
                                                       "TEXCOORD_1": 2}, "material": 0}]}],
            "buffers": [{"byteLength": 84, "uri": "x.bin"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36},
                            {"buffer": 0, "byteOffset": 36, "byteLength": 24},
                            {"buffer": 0, "byteOffset": 60, "byteLength": 24}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
                          {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"}],
            "images": [{"uri": "a.png"}, {"uri": "b.png"}, {"uri": "c.png"}],
            "textures": [{"source": 0}, {"source": 1}, {"source": 2}]})");
        json["materials"] = {Json::parse(material)};
        return json;
    }
    Scene load_json(const Json& json) { return load("x.gltf", json.dump()); }
    Scene load_material(const std::string& material) { return load_json(document(material)); }
};

TEST_F(GltfSceneTextures, BaseColourIsTheDiffuseTexture) {
    image<std::uint8_t>("a.png", {2, 1}, Bytes{255, 255, 255, 0, 255, 0});
    const Scene scene = load_material(R"({"name": "m", "pbrMetallicRoughness": {
        "metallicFactor": 0, "baseColorFactor": [0.5, 0.25, 1, 1], "baseColorTexture": {"index": 0}}})");
    const Material& m = scene.materials[0];
    ASSERT_EQ(m.textures.diffuse, 0);
    const Texture& t = texture(scene, 0);
    EXPECT_EQ(t.texels, (std::vector<Spectrum>{{0.5f, 0.25f, 1.0f}, {0.0f, 0.25f, 0.0f}}));
    EXPECT_EQ(m.diffuse, Spectrum(0.25f, 0.25f, 0.5f)) << "the mean";
    EXPECT_FALSE(t.levels.empty());
    EXPECT_EQ(t.wrap_u, Texture::Wrap::repeat);
    // no metal: 0.04 everywhere, and a uniform property has no texture
    EXPECT_EQ(m.textures.specular, -1);
    expect_near(m.specular, Spectrum(0.04f));
    EXPECT_EQ(m.textures.roughness, -1);
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.uvs, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_TRUE(monitor_.warnings.empty());
}

TEST_F(GltfSceneTextures, MetalnessMovesColourFromDiffuseToSpecular) {
    image<std::uint8_t>("a.png", {1, 1}, Bytes{255, 255, 0});
    // roughness in green, metalness in blue, as stored: 51 is 0.2, 102 is 0.4
    image<std::uint8_t>("b.png", {2, 1}, Bytes{7, 51, 255, 7, 102, 0});
    const Scene scene = load_material(R"({"name": "m", "pbrMetallicRoughness": {
        "metallicFactor": 0.5, "roughnessFactor": 0.5, "baseColorFactor": [1, 0.5, 1, 1],
        "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}}})");
    const Material& m = scene.materials[0];
    const Texture& diffuse = texture(scene, m.textures.diffuse);
    const Texture& specular = texture(scene, m.textures.specular);
    const Texture& roughness = texture(scene, m.textures.roughness);
    expect_near(diffuse.texels[0], {0.5f, 0.25f, 0.0f});
    expect_near(diffuse.texels[1], {1.0f, 0.5f, 0.0f});
    expect_near(specular.texels[0], {0.52f, 0.27f, 0.02f});
    expect_near(specular.texels[1], Spectrum(0.04f));
    expect_near(roughness.texels[0], Spectrum(0.1f));
    expect_near(roughness.texels[1], Spectrum(0.2f));
    expect_near(m.diffuse, {0.75f, 0.375f, 0.0f});
    EXPECT_NEAR(m.roughness, 0.15f, rounding);
}

TEST_F(GltfSceneTextures, ImagesOfDifferentSizesMeetOnTheFinerGrid) {
    image<std::uint8_t>("a.png", {4, 2}, Bytes(24, 255));
    image<std::uint8_t>("b.png", {1, 8}, [] {
        Bytes bytes;
        for (int i = 0; i < 8; ++i) bytes.insert(bytes.end(), {0, 255, std::uint8_t(32 * i)});
        return bytes;
    }());
    const Scene scene = load_material(R"({"name": "m", "pbrMetallicRoughness": {
        "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}}})");
    const Texture& diffuse = texture(scene, scene.materials[0].textures.diffuse);
    EXPECT_EQ(diffuse.width, 4);
    EXPECT_EQ(diffuse.height, 8);
    for (std::size_t i = 0; i < 32; ++i)
        expect_near(diffuse.texels[i], Spectrum(1.0f - 32.0f * static_cast<float>(i / 4) / 255.0f));
}

TEST_F(GltfSceneTextures, EmissionIsTextureTimesFactorTimesStrength) {
    image<std::uint8_t>("c.png", {2, 1}, Bytes{255, 0, 255, 0, 0, 255});
    const std::string texture_of = R"(, "emissiveTexture": {"index": 2}})";
    const Scene scene = load_material(R"({"name": "m", "emissiveFactor": [1, 1, 0.5],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}})" +
                                      texture_of);
    const Material& m = scene.materials[0];
    EXPECT_EQ(texture(scene, m.textures.emission).texels,
              (std::vector<Spectrum>{{8, 0, 4}, {0, 0, 4}}));
    EXPECT_EQ(m.emission, Spectrum(4, 0, 4));
    EXPECT_EQ(load_material(R"({"name": "m")" + texture_of).materials[0].emission, Spectrum(0.0f));
}

TEST_F(GltfSceneTextures, WrapsAsItsSamplerSays) {
    image<std::uint8_t>("a.png", {2, 1}, Bytes{255, 255, 255, 0, 0, 0});
    Json json = document(
        R"({"name": "m", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}})");
    json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    json["textures"][0]["sampler"] = 0;
    const Scene scene = load_json(json);
    EXPECT_EQ(scene.textures.at(0)->wrap_u, Texture::Wrap::clamp);
    EXPECT_EQ(scene.textures.at(0)->wrap_v, Texture::Wrap::mirrored);
    json["samplers"][0]["wrapS"] = 5;
    expect_refused("x.gltf", json.dump(), {"samplers", "wrapS is 5; accepted: 10497"});
}

TEST_F(GltfSceneTextures, PlacesTextureCoordinates) {
    image<std::uint8_t>("a.png", {2, 1}, Bytes{255, 255, 255, 0, 0, 0});
    const auto uvs = [&](const std::string& use) {
        return load_material(R"({"name": "m", "pbrMetallicRoughness": {"baseColorTexture": )" +
                             use + "}}")
            .uvs;
    };
    EXPECT_EQ(uvs(R"({"index": 0, "texCoord": 1})"),
              (std::vector<glm::vec2>{{0.5f, 0.5f}, {1, 0.5f}, {0.5f, 1}}));
    // A quarter turn, counter-clockwise as seen with v downwards, takes (1, 0) to (0, -1).
    const auto turned = uvs(R"({"index": 0, "extensions": {"KHR_texture_transform":
        {"offset": [0.25, 0.5], "rotation": 1.5707963267948966, "scale": [2, 3]}}})");
    const std::vector<glm::vec2> expected{{0.25f, 0.5f}, {0.25f, -1.5f}, {3.25f, 0.5f}};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(turned[i].x, expected[i].x, rounding);
        EXPECT_NEAR(turned[i].y, expected[i].y, rounding);
    }
    EXPECT_EQ(uvs(R"({"index": 0, "extensions": {"KHR_texture_transform": {"texCoord": 1}}})")[0],
              glm::vec2(0.5f));
    EXPECT_THROW((void)uvs(R"({"index": 0, "extensions": {"KHR_texture_transform":
        {"scale": [1e39, 1]}}})"),
                 InputError);
}

TEST_F(GltfSceneTextures, TakesTheMeanOfATextureWithCoordinatesOfItsOwn) {
    image<std::uint8_t>("a.png", {2, 1}, Bytes{255, 255, 255, 0, 0, 0});
    image<std::uint8_t>("c.png", {2, 1}, Bytes{255, 255, 255, 0, 0, 0});
    const Scene scene = load_material(R"({"name": "m", "emissiveFactor": [1, 1, 1],
        "emissiveTexture": {"index": 2, "texCoord": 1},
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})");
    EXPECT_EQ(scene.materials[0].textures.emission, -1);
    EXPECT_EQ(scene.materials[0].emission, Spectrum(0.5f));
    EXPECT_TRUE(warned("'m': its emissiveTexture has texture coordinates of its own"));
}

TEST_F(GltfSceneTextures, FacesWithoutCoordinatesGetTheMean) {
    image<std::uint8_t>("a.png", {2, 1}, Bytes{255, 255, 255, 0, 0, 0});
    Json json = document(
        R"({"name": "m", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}})");
    Json bare = json["meshes"][0]["primitives"][0];
    bare["attributes"].erase("TEXCOORD_0");
    json["meshes"][0]["primitives"].push_back(bare);
    const Scene scene = load_json(json);
    ASSERT_EQ(scene.polygons.size(), 2u);
    EXPECT_EQ(scene.materials.at(scene.polygons[0].material).textures.diffuse, 0);
    const Material& uniform = scene.materials.at(scene.polygons[1].material);
    EXPECT_EQ(uniform.textures.diffuse, -1);
    EXPECT_EQ(uniform.diffuse, Spectrum(0.5f));
    EXPECT_EQ(scene.uvs.size(), scene.corners.size());
    EXPECT_TRUE(warned("faces without texture coordinates"));
}

TEST_F(GltfSceneTextures, MaterialsShareTexturesMadeAlike) {
    image<std::uint8_t>("a.png", {2, 1}, Bytes{255, 255, 255, 0, 0, 0});
    const std::string pbr =
        R"("pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": 0}}})";
    Json json = document(R"({"name": "m", )" + pbr);
    json["materials"].push_back(Json::parse(R"({"name": "n", "doubleSided": true, )" + pbr));
    Json second = json["meshes"][0]["primitives"][0];
    second["material"] = 1;
    json["meshes"][0]["primitives"].push_back(second);
    const Scene scene = load_json(json);
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials[1].textures.diffuse, 0);
    EXPECT_EQ(scene.materials[1].diffuse, scene.materials[0].diffuse);
    EXPECT_TRUE(scene.materials[1].back_reflects);
}

TEST_F(GltfSceneTextures, MissingImagesLeaveTheFactors) {
    const Scene scene = load_material(R"({"name": "m", "emissiveFactor": [1, 0.5, 0],
        "emissiveTexture": {"index": 2}, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
        "baseColorFactor": [0.5, 0.25, 1, 1], "metallicFactor": 0}})");
    EXPECT_EQ(scene.materials[0].diffuse, Spectrum(0.5f, 0.25f, 1.0f));
    EXPECT_EQ(scene.materials[0].emission, Spectrum(1.0f, 0.5f, 0.0f));
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_TRUE(warned("materials[0] 'm': the image of its baseColorTexture"));
    EXPECT_TRUE(warned("a.png', is not there; the factor alone is taken"));
    EXPECT_TRUE(warned("emissiveTexture"));
}

TEST_F(GltfSceneTextures, SaysWhatAlphaWouldCutOut) {
    image<std::uint8_t>("a.png", {4, 1, 4},
                        Bytes{255, 0, 0, 255, 0, 255, 0, 0,  //
                              0, 0, 255, 255, 9, 9, 9, 255});
    const std::string pbr = R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";
    EXPECT_EQ(load_material(R"({"name": "m", "alphaMode": "MASK", )" + pbr).materials[0].opacity,
              1.0f);
    EXPECT_TRUE(warned("'m': its base colour texture cuts out 25 %"));
    EXPECT_EQ(load_material(R"({"name": "m", "alphaMode": "BLEND", )" + pbr).materials[0].opacity,
              0.75f);
}

class ObjSceneTextures : public SceneTextures {
protected:
    Scene load_material(const std::string& statements) {
        write("m.mtl", "newmtl m\n" + statements);
        return load("x.obj",
                    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0.25 0\nvt 1 0.125\nvt 0.5 1\n"
                    "usemtl m\nf 1/1 2/2 3/3\n");
    }
};

TEST_F(ObjSceneTextures, MapsMultiplyTheirFactors) {
    image<float>("d.exr", {2, 1}, Floats{0.5f, 1.0f, 0.0f, 1.0f, 1.0f, 1.0f});
    image<float>("s.exr", {2, 1}, Floats{0.5f, 0.5f, 0.5f, 0.0f, 0.0f, 0.0f});
    image<float>("e.exr", {2, 1}, Floats{20.0f, 4.0f, 0.0f, 0.0f, 0.0f, 0.0f});
    const Scene scene = load_material(
        "Kd 0.5 0.5 0.5\nKs 0.5 0.25 0\nNs 8\nKe 2 2 2\nmap_Kd d.exr\nmap_Ks s.exr\nmap_Ke "
        "e.exr\n");
    const Material& m = scene.materials[0];
    EXPECT_EQ(texture(scene, m.textures.diffuse).texels,
              (std::vector<Spectrum>{{0.25f, 0.5f, 0.0f}, {0.5f, 0.5f, 0.5f}}));
    EXPECT_EQ(texture(scene, m.textures.specular).texels[0], Spectrum(0.25f, 0.125f, 0.0f));
    EXPECT_EQ(texture(scene, m.textures.emission).texels[0], Spectrum(40.0f, 8.0f, 0.0f));
    EXPECT_EQ(m.diffuse, Spectrum(0.375f, 0.5f, 0.25f));
    EXPECT_EQ(m.specular, Spectrum(0.125f, 0.0625f, 0.0f));
    EXPECT_EQ(m.emission, Spectrum(20.0f, 4.0f, 0.0f));
    EXPECT_EQ(m.shininess, 8.0f);
    EXPECT_TRUE(monitor_.warnings.empty());
}

TEST_F(ObjSceneTextures, MapsWithoutFactorsStandAlone) {
    image<float>("d.exr", {2, 1}, Floats{0.5f, 1.0f, 0.0f, 1.0f, 1.0f, 1.0f});
    const Scene scene = load_material("map_Kd d.exr\nmap_Ks d.exr\nmap_Ke d.exr\n");
    const Material& m = scene.materials[0];
    const Spectrum mean(0.75f, 1.0f, 0.5f);
    EXPECT_EQ(m.diffuse, mean);
    EXPECT_EQ(m.specular, mean);
    EXPECT_EQ(m.emission, mean);
    EXPECT_EQ(m.textures.specular, m.textures.diffuse) << "made once";
}

TEST_F(ObjSceneTextures, MissingMapsLeaveTheFactors) {
    const Material given =
        load_material(
            "Kd 0.25 0.5 1\nKe 1 1 1\nmap_Kd gone.png\nmap_Ke gone.png\nmap_Ks gone.png\n")
            .materials[0];
    EXPECT_EQ(given.diffuse, Spectrum(0.25f, 0.5f, 1.0f));
    EXPECT_EQ(given.emission, Spectrum(1.0f));
    EXPECT_EQ(given.specular, Spectrum(0.0f));
    EXPECT_TRUE(warned("material 'm': its texture"));
    EXPECT_TRUE(warned("gone.png' is not there; 0.25 0.5 1 is taken"));
    EXPECT_EQ(load_material("map_Kd gone.png\n").materials[0].diffuse, Spectrum(0.5f));
    EXPECT_TRUE(warned("gone.png' is not there; 0.5 0.5 0.5 is taken"));
}

TEST_F(ObjSceneTextures, TextureCoordinatesRunUpwards) {
    EXPECT_EQ(load_material("Kd 1 1 1\n").uvs,
              (std::vector<glm::vec2>{{0.25f, 1.0f}, {1.0f, 0.875f}, {0.5f, 0.0f}}));
    // The lower left quarter, from the file's point of view, is white.
    image<std::uint8_t>("d.png", {2, 2, 1}, Bytes{0, 0, 255, 0});
    const Scene scene = load_material("map_Kd d.png\n");
    EXPECT_EQ(scene.textures.at(0)->at({0.25f, 1.0f - 0.25f}), Spectrum(1.0f));
}

TEST_F(ObjSceneTextures, MapsAreScaledThenMoved) {
    image<std::uint8_t>("d.png", {2, 1, 1}, Bytes{0, 255});
    const Scene scene = load_material("map_Kd -s 2 4 1 -o 0.5 0.25 0 -clamp on d.png\n");
    EXPECT_EQ(scene.uvs, (std::vector<glm::vec2>{{1.0f, 0.75f}, {2.5f, 0.25f}, {1.5f, -3.25f}}));
    EXPECT_EQ(scene.textures.at(0)->wrap_u, Texture::Wrap::clamp);
    EXPECT_TRUE(monitor_.warnings.empty());
    const Material m = load_material("map_Kd d.png\nmap_Ks -s 2 2 2 d.png\n").materials[0];
    EXPECT_EQ(m.textures.specular, -1);
    EXPECT_EQ(m.specular, Spectrum(0.5f));
    EXPECT_TRUE(warned("is placed apart from its first; its mean is taken"));
    (void)load_material("map_Kd -bm 2 -imfchan r d.png\n");
    EXPECT_TRUE(warned("m.mtl:2: material 'm': option '-bm' is not honoured"));
    EXPECT_TRUE(warned("option '-imfchan' is not honoured"));
}

TEST_F(ObjSceneTextures, FacesWithoutCoordinatesGetTheMean) {
    image<std::uint8_t>("d.png", {2, 1, 1}, Bytes{0, 255});
    write("m.mtl", "newmtl m\nmap_Kd d.png\n");
    const Scene scene = load("x.obj",
                             "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                             "usemtl m\nf 1/1 2/2 3/3\nf 1 3/1 2/2\n");
    EXPECT_EQ(scene.materials.at(scene.polygons[0].material).textures.diffuse, 0);
    EXPECT_EQ(scene.materials.at(scene.polygons[1].material).textures.diffuse, -1);
    EXPECT_EQ(scene.materials.at(scene.polygons[1].material).diffuse, Spectrum(0.5f));
}

TEST_F(ObjSceneTextures, WithoutAnyCoordinatesThereIsNoTexture) {
    image<std::uint8_t>("d.png", {2, 1, 1}, Bytes{0, 255});
    write("m.mtl", "newmtl m\nmap_Kd d.png\n");
    const Scene scene =
        load("x.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl m\nf 1 2 3\n");
    EXPECT_TRUE(scene.uvs.empty());
    EXPECT_TRUE(scene.textures.empty());
    for (const Material& m : scene.materials) {
        EXPECT_EQ(m.textures.diffuse, -1);
        EXPECT_EQ(m.diffuse, Spectrum(0.5f));
    }
}

}  // namespace

}  // namespace transillum
