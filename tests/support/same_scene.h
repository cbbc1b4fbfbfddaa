/// Expectations that what was read back is what was written.
#pragma once

#include <transillum/scene/scene.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace transillum::testing_support {

/// A polygon with all that it stands for. Objects are numbered as they come, for those that no
/// polygon has are not written.
struct WholePolygon {
    std::uint32_t object = 0, material = 0;
    std::string object_name;
    std::vector<double> positions;
    std::vector<float> uvs;

    auto operator<=>(const WholePolygon&) const = default;
};

struct Compared {
    bool objects = true, materials = true, uvs = true;
    bool order = true;    ///< else polygons of an object may come in another
    bool floats = false;  ///< positions of the first scene are rounded before they are compared
};

inline std::vector<WholePolygon> whole_polygons(const Scene& scene, const Compared& compared,
                                                bool round) {
    std::map<std::uint32_t, std::uint32_t> number_of_object;
    for (const Polygon& p : scene.polygons) number_of_object.try_emplace(p.object, 0u);
    std::uint32_t next = 0;
    for (auto& [object, number] : number_of_object) number = next++;
    std::vector<WholePolygon> whole;
    for (const Polygon& p : scene.polygons) {
        WholePolygon& w = whole.emplace_back();
        if (compared.objects) {
            w.object = number_of_object[p.object];
            w.object_name = scene.objects[p.object];
        }
        if (compared.materials) w.material = p.material;
        for (std::uint32_t c = p.first_corner; c < p.first_corner + p.corner_count; ++c) {
            const glm::dvec3& at = scene.positions[scene.corners[c]];
            for (int axis = 0; axis < 3; ++axis)
                w.positions.push_back(round ? static_cast<double>(static_cast<float>(at[axis]))
                                            : at[axis]);
            if (compared.uvs && !scene.uvs.empty())
                w.uvs.insert(w.uvs.end(), {scene.uvs[c].x, scene.uvs[c].y});
        }
    }
    if (compared.objects) std::ranges::stable_sort(whole, {}, &WholePolygon::object);
    if (!compared.order) std::ranges::sort(whole);
    return whole;
}

inline void expect_same_polygons(const Scene& written, const Scene& read,
                                 const Compared& compared = {}) {
    const auto a = whole_polygons(written, compared, compared.floats);
    const auto b = whole_polygons(read, compared, false);
    ASSERT_EQ(a.size(), b.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) different += a[i] != b[i];
    EXPECT_EQ(different, 0u) << "of " << a.size() << " polygons";
}

inline void expect_near(const Spectrum& a, const Spectrum& b, float tolerance,
                        const std::string& what) {
    for (int c = 0; c < channel_count; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << what;
}

/// \param tolerance of a texel, over the largest
inline void expect_same_texture(const Scene& sa, std::int32_t ia, const Scene& sb, std::int32_t ib,
                                float tolerance, const std::string& what) {
    ASSERT_EQ(ia < 0, ib < 0) << what;
    if (ia < 0) return;
    const Texture& a = *sa.textures.at(ia);
    const Texture& b = *sb.textures.at(ib);
    ASSERT_EQ(a.width, b.width) << what;
    ASSERT_EQ(a.height, b.height) << what;
    EXPECT_EQ(a.wrap_u, b.wrap_u) << what;
    EXPECT_EQ(a.wrap_v, b.wrap_v) << what;
    float largest = 0.0f, error = 0.0f;
    for (std::size_t t = 0; t < a.texels.size(); ++t) {
        largest = std::max(largest, max_channel(a.texels[t]));
        error = std::max(error, max_channel(glm::abs(a.texels[t] - b.texels[t])));
    }
    EXPECT_LE(error, tolerance * largest) << what;
}

/// \param rounding of uniform values, relative
/// \param texel_rounding of texels, over the largest
inline void expect_same_materials(const Scene& a, const Scene& b, float rounding,
                                  float texel_rounding = 0.0f) {
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (std::size_t i = 0; i < a.materials.size(); ++i) {
        const Material& x = a.materials[i];
        const Material& y = b.materials[i];
        SCOPED_TRACE(x.name);
        const auto near = [&](const Spectrum& s, const Spectrum& t, const char* what) {
            const float scale = std::max(max_channel(s), 1e-3f);
            expect_near(s, t, (rounding + texel_rounding) * scale, what);
        };
        near(x.diffuse, y.diffuse, "diffuse");
        near(x.specular, y.specular, "specular");
        near(x.emission, y.emission, "emission");
        EXPECT_EQ(x.lobe, y.lobe);
        if (x.lobe == Lobe::ggx) {
            EXPECT_NEAR(x.roughness, y.roughness, rounding + texel_rounding);
        }
        if (x.lobe == Lobe::max_phong) {
            EXPECT_EQ(x.shininess, y.shininess);
        }
        EXPECT_EQ(x.back_reflects, y.back_reflects);
        if (x.emits()) {
            EXPECT_EQ(x.back_emits, y.back_emits);
        }
        EXPECT_NEAR(x.opacity, y.opacity, rounding);
        const auto same_texture = [&](std::int32_t s, std::int32_t t, const char* what) {
            expect_same_texture(a, s, b, t, texel_rounding, what);
        };
        same_texture(x.textures.diffuse, y.textures.diffuse, "diffuse texture");
        same_texture(x.textures.specular, y.textures.specular, "specular texture");
        same_texture(x.textures.roughness, y.textures.roughness, "roughness texture");
        same_texture(x.textures.emission, y.textures.emission, "emission texture");
    }
}

}  // namespace transillum::testing_support
