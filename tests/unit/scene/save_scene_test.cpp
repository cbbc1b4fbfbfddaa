// What is written is read back as it was, in every format, as far as the format can hold it.
#include "support/same_scene.h"
#include "unit/scene/scene_files.h"

#include <transillum/base/srgb.h>
#include <transillum/scene/save_scene.h>

#include <glm/geometric.hpp>

#include <set>

namespace transillum {

namespace {

using testing_support::expect_same_materials;
using testing_support::expect_same_polygons;

constexpr float rounding = 3e-7f;  // a few float operations
/// Half a step of 16 bits where the curve of sRGB is steepest, and of metalness.
constexpr float texel_rounding = 0.5f / 65535.0f * (2.28f + 1.0f) + 1e-6f;

struct Corner {
    glm::dvec3 position;
    glm::vec2 uv{0.0f};
};

void add_polygon(Scene& scene, const std::vector<Corner>& corners, std::uint32_t material,
                 std::uint32_t object) {
    const auto first = static_cast<std::uint32_t>(scene.corners.size());
    for (const Corner& c : corners) {
        scene.corners.push_back(static_cast<std::uint32_t>(scene.positions.size()));
        scene.positions.push_back(c.position);
        scene.uvs.push_back(c.uv);
    }
    scene.polygons.push_back({first, static_cast<std::uint32_t>(corners.size()), material, object,
                              static_cast<std::uint32_t>(scene.polygons.size())});
}

Material named(const char* name) {
    Material m;
    m.name = name;
    return m;
}

/// Materials of every kind that one of the formats holds.
std::vector<Material> lambert_materials() {
    Material plain = named("red # wall"), lamp = named("lamp"), glass = named("thin glass");
    plain.diffuse = {0.1f, 1.0f / 3.0f, 0.7f};
    lamp.emission = {17.1f, 12.3f, 1e-3f};
    glass.opacity = 0.3f;
    return {plain, lamp, glass};
}

/// Two objects whose polygons take turns; coordinates that need all their digits.
Scene two_objects(std::vector<Material> materials) {
    Scene scene;
    scene.path = "made";
    scene.materials = std::move(materials);
    scene.objects = {"table top", "lamp"};
    const auto count = static_cast<std::uint32_t>(scene.materials.size());
    for (std::uint32_t i = 0; i < 2 * count; ++i) {
        const double x = i / 3.0;
        add_polygon(scene,
                    {{{x, 0.1, 1e-17}, {0.1f, 1e-8f}},
                     {{x + 1.0 / 7.0, -0.3, 1e10 / 3.0}, {0.9f, -7.3f}},
                     {{x, 1.0 / 3.0, 2.0}, {1.0f / 3.0f, 0.7f}}},
                    i % count, i % 2);
    }
    return scene;
}

Scene with_pentagon(Scene scene) {
    add_polygon(scene, {{{0, 0, 0}}, {{1, 0, 0.1}}, {{1, 1, 0}}, {{0.5, 0.2, 0}}, {{0, 1, 0}}}, 0,
                1);
    return scene;
}

Camera camera_of(const char* name) {
    return {.name = name,
            .eye = {1.0 / 3.0, 2.0, -4.1},
            .look_at = {0.1, 0.2, 0.3},
            .up = {0.1, 1.0, 0.0},
            .vertical_fov = 41.7};
}

class SaveScene : public SceneFiles {
protected:
    Scene save_and_load(const Scene& scene, const std::string& name) {
        save_scene(scene, folder_ / name, monitor_);
        RecordingMonitor reading;
        Scene read = load_scene(folder_ / name, {}, reading);
        for (const std::string& text : reading.warnings)
            EXPECT_NE(text.find("transparent"), std::string::npos) << text;
        return read;
    }
    void expect_warning(const std::string& part) const {
        EXPECT_TRUE(RecordingMonitor::any_names(monitor_.warnings, part)) << part;
    }
    std::set<std::string> listing() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_))
            names.insert(entry.path().filename().string());
        return names;
    }
};

// --- OBJ ---

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

// --- PLY, OFF, STL ---

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

// --- glTF ---

std::vector<Material> gltf_materials() {
    std::vector<Material> materials = lambert_materials();
    Material plastic = named("plastic"), metal = named("metal"), mixed = named("mixed"),
             odd = named("odd"), one_sided = named("one-sided"), both = named("both sides");
    for (Material* m : {&plastic, &metal, &mixed, &odd}) m->lobe = Lobe::ggx;
    plastic.specular = Spectrum(0.04f);
    plastic.roughness = 0.3f;
    metal.diffuse = Spectrum(0.0f);
    metal.specular = {1.0f, 0.7f, 1.0f / 3.0f};
    metal.roughness = 0.1f;
    mixed.diffuse = Spectrum(0.6f, 0.3f, 0.1f) * 0.25f;
    mixed.specular = Spectrum(0.04f * 0.25f) + 0.75f * Spectrum(0.6f, 0.3f, 0.1f);
    odd.specular = {0.2f, 0.01f, 0.05f};
    one_sided.back_reflects = false;
    both.emission = Spectrum(3.0f);
    both.back_emits = true;
    materials[1].back_reflects = false;  // a lamp of one side
    for (const Material& m : {plastic, metal, mixed, odd, one_sided, both}) materials.push_back(m);
    return materials;
}

class SaveGltf : public SaveScene, public testing::WithParamInterface<const char*> {
protected:
    const std::string name_ = std::string("room 1.") + GetParam();
};

INSTANTIATE_TEST_SUITE_P(All, SaveGltf, testing::Values("gltf", "glb"));

TEST_P(SaveGltf, KeepsTrianglesAndMaterials) {
    Scene scene = two_objects(gltf_materials());
    // Not in place: g++ 12 leaves the last ones of such a loop unrounded at -O3.
    std::vector<glm::vec3> rounded(scene.positions.begin(), scene.positions.end());
    scene.positions.assign(rounded.begin(), rounded.end());
    const Scene read = save_and_load(scene, name_);
    EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];
    EXPECT_TRUE(monitor_.notes.empty()) << monitor_.notes[0];
    expect_same_polygons(scene, read, {.order = false});
    expect_same_materials(scene, read, rounding);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        EXPECT_EQ(read.materials[i].name, scene.materials[i].name);
    EXPECT_EQ(listing(), std::string(GetParam()) == "glb"
                             ? (std::set<std::string>{"room 1.glb"})
                             : (std::set<std::string>{"room 1.gltf", "room_1.bin"}));
}

TEST_P(SaveGltf, RoundsAndTellsHowFar) {
    const Scene scene = two_objects(gltf_materials());
    const Scene read = save_and_load(scene, name_);
    expect_same_polygons(scene, read, {.order = false, .floats = true});
    ASSERT_EQ(monitor_.notes.size(), 1u);
    EXPECT_NE(monitor_.notes[0].find("moved by up to "), std::string::npos);
}

TEST_P(SaveGltf, KeepsCamerasAndLights) {
    Scene scene = two_objects(gltf_materials());
    scene.cameras = {camera_of("the front")};
    using Kind = PunctualLight::Kind;
    PunctualLight point, spot, sun;
    point.name = "bulb";
    point.position = {0.1, 2.0 / 3.0, 7.0};
    spot.name = "spot";
    spot.kind = Kind::spot;
    sun.name = "sun";
    sun.kind = Kind::directional;
    point.intensity = {1.0f / 3.0f, 0.7f, 123.4f};
    spot.direction = glm::normalize(glm::dvec3(1, -2, 0.5));
    spot.inner_angle = 0.1;
    spot.outer_angle = 0.3;
    sun.direction = {0.0, -1.0, 0.0};  // along `up`
    sun.intensity = Spectrum(0.0f);
    scene.lighting.lights = {point, spot, sun};
    const Scene read = save_and_load(scene, name_);
    EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];

    ASSERT_EQ(read.cameras.size(), 1u);
    const Camera &a = scene.cameras[0], &b = read.cameras[0];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.eye, b.eye);
    EXPECT_NEAR(a.vertical_fov, b.vertical_fov, 1e-13);
    const auto forward = [](const Camera& c) { return glm::normalize(c.look_at - c.eye); };
    const auto right = [&](const Camera& c) {
        return glm::normalize(glm::cross(forward(c), c.up));
    };
    EXPECT_LT(glm::distance(forward(a), forward(b)), 1e-14);
    EXPECT_LT(glm::distance(right(a), right(b)), 1e-14);

    ASSERT_EQ(read.lighting.lights.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const PunctualLight &x = scene.lighting.lights[i], &y = read.lighting.lights[i];
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(x.kind, y.kind);
        EXPECT_EQ(x.intensity, y.intensity);
        EXPECT_EQ(x.position, y.position);
        EXPECT_LT(glm::distance(x.direction, y.direction), 1e-15);
    }
    EXPECT_EQ(read.lighting.lights[1].inner_angle, 0.1);
    EXPECT_EQ(read.lighting.lights[1].outer_angle, 0.3);
}

TEST_P(SaveGltf, RefusesPolygons) {
    const Scene scene = with_pentagon(two_objects({named("m")}));
    try {
        save_scene(scene, folder_ / name_, monitor_);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "made: face 2 has 5 corners; accepted by glTF: 3");
    }
    EXPECT_TRUE(listing().empty());
}

// --- textures ---

std::int32_t add_texture(Scene& scene, int width, int height, auto&& texel_of) {
    Texture texture{.name = "t", .width = width, .height = height};
    for (int i = 0; i < width * height; ++i) texture.texels.push_back(texel_of(i));
    texture.build_levels();
    scene.textures.push_back(std::make_shared<const Texture>(std::move(texture)));
    return static_cast<std::int32_t>(scene.textures.size() - 1);
}

float of_8_bits(int i) {
    return linear_from_srgb(static_cast<float>(i % 256) / 255.0f);
}

Spectrum mean_of(const Scene& scene, std::int32_t texture) {
    return scene.textures.at(texture)->mean();
}

TEST_F(SaveScene, TexturesOf8BitsAreKeptToTheBit) {
    std::vector<Material> materials{named("a"), named("b"), named("no texture")};
    Scene scene = two_objects(materials);
    const auto plain = add_texture(scene, 7, 5, [](int i) {
        return Spectrum(of_8_bits(7 * i), of_8_bits(i + 100), of_8_bits(3 * i));
    });
    const auto bright = add_texture(scene, 16, 16, [](int i) {
        return Spectrum(of_8_bits(i), of_8_bits(255 - i), 0.0f) * Spectrum(17.0f, 0.3f, 1.0f);
    });
    for (Material& m : scene.materials) m.diffuse = Spectrum(0.5f);
    scene.materials[0].textures.diffuse = plain;
    scene.materials[0].diffuse = mean_of(scene, plain);
    scene.materials[1].textures = {.diffuse = plain, .emission = bright};
    scene.materials[1].diffuse = mean_of(scene, plain);
    scene.materials[1].emission = mean_of(scene, bright);
    scene.materials[1].back_reflects = true;
    const Scene from_obj = save_and_load(scene, "x.obj");
    expect_same_materials(scene, from_obj, 0.0f);
    expect_same_polygons(scene, from_obj);
    EXPECT_TRUE(monitor_.notes.empty()) << monitor_.notes[0];
    scene.materials[1].back_emits = true;
    for (const char* name : {"x.gltf", "x.glb"})
        expect_same_materials(scene, save_and_load(scene, name), rounding);
    for (const std::string& note : monitor_.notes)
        EXPECT_EQ(note.find("16 bits"), std::string::npos) << note;
    EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];
    EXPECT_EQ(listing().count("x-texture-2.png"), 1u);
}

TEST_F(SaveScene, OtherTexturesAreKeptWithinTheStepOf16Bits) {
    Scene scene = two_objects({named("a")});
    scene.materials[0].textures.diffuse = add_texture(scene, 9, 8, [](int i) {
        return Spectrum(0.013f * static_cast<float>(i), 0.001f * static_cast<float>(i), 0.9f);
    });
    scene.materials[0].textures.emission = add_texture(scene, 9, 8, [](int i) {
        return Spectrum(0.013f * static_cast<float>(i * i), static_cast<float>(i), 0.9f);
    });
    Material& m = scene.materials[0];
    m.diffuse = mean_of(scene, m.textures.diffuse);
    m.emission = mean_of(scene, m.textures.emission);
    expect_same_materials(scene, save_and_load(scene, "x.obj"), rounding, texel_rounding);
    m.back_emits = true;
    expect_same_materials(scene, save_and_load(scene, "x.gltf"), rounding, texel_rounding);
    EXPECT_TRUE(RecordingMonitor::any_names(monitor_.notes, "16 bits a channel"));
}

/// Base colour, metalness and roughness that vary, as a glTF file would have them.
TEST_F(SaveScene, GltfSolvesForBaseColourAndMetalness) {
    Scene scene = two_objects({named("a"), named("b")});
    const auto base = [](int i) {
        return Spectrum(of_8_bits(5 * i), of_8_bits(i + 30), of_8_bits(2 * i + 9));
    };
    const auto metallic = [](int i) { return static_cast<float>(i % 6) / 5.0f; };
    Material& m = scene.materials[0];
    m.lobe = Lobe::ggx;
    m.textures.diffuse =
        add_texture(scene, 6, 6, [&](int i) { return base(i) * (1.0f - metallic(i)); });
    m.textures.specular = add_texture(
        scene, 6, 6, [&](int i) { return glm::mix(Spectrum(0.04f), base(i), metallic(i)); });
    m.textures.roughness =
        add_texture(scene, 6, 6, [](int i) { return Spectrum(static_cast<float>(i) / 255.0f); });
    m.diffuse = mean_of(scene, m.textures.diffuse);
    m.specular = mean_of(scene, m.textures.specular);
    m.roughness = mean_of(scene, m.textures.roughness).r;
    Material& rough = scene.materials[1];
    rough.lobe = Lobe::ggx;
    rough.specular = Spectrum(0.3f);
    rough.textures.roughness = m.textures.roughness;
    rough.roughness = m.roughness;
    for (const char* name : {"x.gltf", "x.glb"})
        expect_same_materials(scene, save_and_load(scene, name), rounding, texel_rounding);
    EXPECT_TRUE(monitor_.warnings.empty()) << monitor_.warnings[0];
}

TEST_F(SaveScene, WrappingIsKept) {
    Scene scene = two_objects({named("a")});
    Texture texture{.width = 2, .height = 1, .texels = {Spectrum(0.0f), Spectrum(1.0f)}};
    texture.wrap_u = texture.wrap_v = Texture::Wrap::clamp;
    Material& m = scene.materials[0];
    m.textures.diffuse = 0;
    scene.textures = {std::make_shared<const Texture>(texture)};
    expect_same_materials(scene, save_and_load(scene, "x.obj"), rounding);
    EXPECT_TRUE(monitor_.warnings.empty());
    texture.wrap_v = Texture::Wrap::mirrored;
    scene.textures = {std::make_shared<const Texture>(texture)};
    expect_same_materials(scene, save_and_load(scene, "x.glb"), rounding);
    EXPECT_TRUE(monitor_.warnings.empty());
    (void)save_and_load(scene, "y.obj");
    expect_warning("mirrored or mixed wrapping");
}

// --- files ---

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
