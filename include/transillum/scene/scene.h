/// A scene as its file says it: a polygon soup with materials, objects and cameras. Nothing is
/// welded, triangulated or repaired here. Lengths are in the file's unit.
#pragma once

#include <transillum/base/spectrum.h>
#include <transillum/scene/lighting.h>
#include <transillum/scene/texture.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace transillum {

/// The glossy lobe beside the Lambert one; see brdf.h.
enum class Lobe : std::uint8_t { none, max_phong, ggx };

/// Textures of a material, as indices into Scene::textures; -1 where it is uniform. Texels hold
/// what the material has there (factors are multiplied in), the uniform values their mean.
struct MaterialTextures {
    std::int32_t diffuse = -1, specular = -1, roughness = -1, emission = -1;
};

/// Surface properties. A surface has a front, where its corners turn counter-clockwise, and a back.
struct Material {
    std::string name;
    Spectrum diffuse{
        0.5f};  ///< Lambert albedo [1]: OBJ `Kd`, glTF base colour times (1 - metallic)
    Spectrum specular{0.0f};  ///< at normal incidence, of the lobe [1]. max-Phong: its albedo, OBJ
                              ///< `Ks`; GGX: its reflectance, glTF 0.04 to base colour by metallic
    Lobe lobe = Lobe::none;
    float shininess = 0.0f;   ///< exponent of the max-Phong lobe: OBJ `Ns`
    float roughness = 1.0f;   ///< of the GGX lobe, glTF's; its alpha is the square
    Spectrum emission{0.0f};  ///< emitted radiance [W sr^-1 m^-2], the same in every direction
    MaterialTextures textures;
    bool back_reflects = true;  ///< else the back is black
    bool back_emits = false;
    float opacity = 1.0f;  ///< below 1 the surface is treated as opaque, with a warning

    /// Reflected share of light, both lobes [1]. Without GGX: diffuse + specular, a bound at any
    /// angle. GGX: that of uniform light; near the horizon, Fresnel's term reflects more.
    [[nodiscard]] Spectrum albedo() const;
    [[nodiscard]] bool emits() const { return max_channel(emission) > 0.0f; }
};

/// A polygon: `corner_count` consecutive entries of Scene::corners. May be concave; may touch
/// itself along a seam; corners may repeat.
struct Polygon {
    std::uint32_t first_corner = 0;
    std::uint32_t corner_count = 0;
    std::uint32_t material = 0;     ///< index into Scene::materials
    std::uint32_t object = 0;       ///< index into Scene::objects
    std::uint32_t source_face = 0;  ///< number of the face in its file, from 0
};

struct Camera {
    std::string name;
    glm::dvec3 eye{0.0, 0.0, 0.0};
    glm::dvec3 look_at{0.0, 0.0, -1.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    double vertical_fov = 45.0;  ///< [degrees], in (0, 180)
};

struct Scene {
    std::string path;  ///< where it came from, for messages
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> corners;  ///< indices into positions
    std::vector<glm::vec2> uvs;          ///< one a corner, or empty
    std::vector<Polygon> polygons;
    std::vector<Material> materials;
    std::vector<std::shared_ptr<const Texture>> textures;
    std::vector<std::string> objects;  ///< names; several may be alike
    std::vector<Camera> cameras;
    Lighting lighting;  ///< beside the materials that emit
};

}  // namespace transillum
