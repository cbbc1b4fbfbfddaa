/// Scenes that are written and read back by the tests.
#pragma once

#include "support/same_scene.h"
#include "unit/scene/scene_files.h"

#include <transillum/base/srgb.h>
#include <transillum/scene/save_scene.h>

#include <set>

namespace transillum {

inline constexpr float rounding = 3e-7f;  // a few float operations

struct Corner {
    glm::dvec3 position;
    glm::vec2 uv{0.0f};
};

inline void add_polygon(Scene& scene, const std::vector<Corner>& corners, std::uint32_t material,
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

inline Material named(const char* name) {
    Material m;
    m.name = name;
    return m;
}

/// Materials of every kind that one of the formats holds.
inline std::vector<Material> lambert_materials() {
    Material plain = named("red # wall"), lamp = named("lamp"), glass = named("thin glass");
    plain.diffuse = {0.1f, 1.0f / 3.0f, 0.7f};
    lamp.emission = {17.1f, 12.3f, 1e-3f};
    glass.opacity = 0.3f;
    return {plain, lamp, glass};
}

/// Two objects whose polygons take turns; coordinates that need all their digits.
inline Scene two_objects(std::vector<Material> materials) {
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

inline Scene with_pentagon(Scene scene) {
    add_polygon(scene, {{{0, 0, 0}}, {{1, 0, 0.1}}, {{1, 1, 0}}, {{0.5, 0.2, 0}}, {{0, 1, 0}}}, 0,
                1);
    return scene;
}

inline Camera camera_of(const char* name) {
    return {.name = name,
            .eye = {1.0 / 3.0, 2.0, -4.1},
            .look_at = {0.1, 0.2, 0.3},
            .up = {0.1, 1.0, 0.0},
            .vertical_fov = 41.7};
}

/// One of `texel_of(index)`. \returns its number
std::int32_t add_texture(Scene& scene, int width, int height, auto&& texel_of) {
    Texture texture{.name = "t", .width = width, .height = height};
    for (int i = 0; i < width * height; ++i) texture.texels.push_back(texel_of(i));
    texture.build_levels();
    scene.textures.push_back(std::make_shared<const Texture>(std::move(texture)));
    return static_cast<std::int32_t>(scene.textures.size() - 1);
}

/// What a byte of sRGB stands for.
inline float of_8_bits(int i) {
    return linear_from_srgb(static_cast<float>(i % 256) / 255.0f);
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

}  // namespace transillum
