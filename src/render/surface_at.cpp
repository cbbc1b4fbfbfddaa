#include "render/surface_at.h"

#include <array>

namespace transillum {

namespace {

std::array<glm::vec2, 3> uvs_of(const SurfaceMesh& mesh, std::uint32_t root) {
    const glm::vec2* uv = &mesh.uvs[3 * static_cast<std::size_t>(root)];
    return {uv[0], uv[1], uv[2]};
}

glm::vec2 uv_at(const SurfaceMesh& mesh, std::uint32_t root, double b1, double b2) {
    const auto uv = uvs_of(mesh, root);
    const auto w1 = static_cast<float>(b1), w2 = static_cast<float>(b2);
    return uv[0] + w1 * (uv[1] - uv[0]) + w2 * (uv[2] - uv[0]);
}

bool is_textured(const MaterialTextures& t) {
    return t.diffuse >= 0 || t.specular >= 0 || t.roughness >= 0;
}

}  // namespace

Brdf brdf_at(const SurfaceMesh& mesh, std::uint32_t root, double b1, double b2) {
    const Material& material = mesh.materials[mesh.triangles[root].material];
    const MaterialTextures& textures = material.textures;
    if (mesh.uvs.empty() || !is_textured(textures)) return brdf_of(material);
    const glm::vec2 uv = uv_at(mesh, root, b1, b2);
    Material here;
    here.lobe = material.lobe;
    here.shininess = material.shininess;
    here.diffuse =
        textures.diffuse < 0 ? material.diffuse : mesh.textures[textures.diffuse]->at(uv);
    here.specular =
        textures.specular < 0 ? material.specular : mesh.textures[textures.specular]->at(uv);
    here.roughness =
        textures.roughness < 0 ? material.roughness : mesh.textures[textures.roughness]->at(uv).x;
    return brdf_of(here);
}

Spectrum emission_at(const SurfaceMesh& mesh, std::uint32_t root, double b1, double b2) {
    const Material& material = mesh.materials[mesh.triangles[root].material];
    if (mesh.uvs.empty() || material.textures.emission < 0) return material.emission;
    return mesh.textures[material.textures.emission]->at(uv_at(mesh, root, b1, b2));
}

glm::vec3 within_leaf(const PatchHierarchy& patches, std::uint32_t leaf, const Hit& hit) {
    const auto [corners, level] = leaf_corners(patches, leaf);
    const auto n = static_cast<float>(1 << level);
    const glm::vec2 p = glm::vec2(hit.b1, hit.b2) * n - glm::vec2(corners[0]);
    const glm::vec2 u(corners[1] - corners[0]), v(corners[2] - corners[0]);
    const float whole = u.x * v.y - u.y * v.x;
    const float b1 = (p.x * v.y - p.y * v.x) / whole, b2 = (u.x * p.y - u.y * p.x) / whole;
    const glm::vec3 inside = glm::max(glm::vec3(1.0f - b1 - b2, b1, b2), glm::vec3(0.0f));
    return inside / (inside.x + inside.y + inside.z);
}

Spectrum mean_emission(const SurfaceMesh& mesh, std::uint32_t root) {
    const Material& material = mesh.materials[mesh.triangles[root].material];
    if (mesh.uvs.empty() || material.textures.emission < 0) return material.emission;
    return mesh.textures[material.textures.emission]->mean_over(uvs_of(mesh, root));
}

}  // namespace transillum
