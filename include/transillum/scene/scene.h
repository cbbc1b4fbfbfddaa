/// A scene as its file says it: a polygon soup with materials, objects and cameras. Nothing is
/// welded, triangulated or repaired here. Lengths are in the file's unit.
#pragma once

#include <transillum/base/spectrum.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace transillum {

/// Surface properties. A surface has a front, where its corners turn counter-clockwise, and a back.
struct Material {
    std::string name;
    Spectrum diffuse{
        0.5f};  ///< Lambert albedo [1]: OBJ `Kd`, glTF base colour times (1 - metallic)
    Spectrum specular{
        0.0f};  ///< albedo of the glossy lobe [1]: OBJ `Ks`, glTF base colour times metallic
    float shininess = 0.0f;     ///< OBJ `Ns`; 0 where there is no glossy lobe
    float roughness = 1.0f;     ///< glTF roughness factor
    Spectrum emission{0.0f};    ///< emitted radiance [W sr^-1 m^-2], the same in every direction
    bool back_reflects = true;  ///< else the back is black
    bool back_emits = false;
    float opacity = 1.0f;  ///< below 1 the surface is treated as opaque, with a warning

    /// Reflected share of the irradiance, both lobes [1].
    [[nodiscard]] Spectrum albedo() const { return diffuse + specular; }
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
    std::vector<std::string> objects;  ///< names; several may be alike
    std::vector<Camera> cameras;
};

}  // namespace transillum
