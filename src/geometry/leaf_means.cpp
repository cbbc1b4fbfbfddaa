#include <transillum/geometry/leaf_means.h>

#include <cmath>

namespace transillum {

namespace {

/// Corners of a leaf in barycentric coordinates of its root.
std::array<glm::vec2, 3> corners_in_root(const PatchHierarchy& patches, std::uint32_t leaf) {
    const LeafCorners lattice = leaf_corners(patches, leaf);
    const float unit = std::ldexp(1.0f, -lattice.level);
    std::array<glm::vec2, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = unit * glm::vec2(lattice.b[i]);
    return corners;
}

}  // namespace

glm::vec2 uv_at(const SurfaceMesh& mesh, std::uint32_t root, float b1, float b2) {
    if (mesh.uvs.empty()) return glm::vec2(0.0f);
    const glm::vec2* uv = mesh.uvs.data() + std::size_t{3} * root;
    return (1.0f - b1 - b2) * uv[0] + b1 * uv[1] + b2 * uv[2];
}

Spectrum texture_mean_over_leaf(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                                const Texture& texture, std::uint32_t leaf) {
    const std::uint32_t root = patches.root_of_leaf[leaf];
    std::array<glm::vec2, 3> uvs;
    const auto corners = corners_in_root(patches, leaf);
    for (std::size_t i = 0; i < 3; ++i) uvs[i] = uv_at(mesh, root, corners[i].x, corners[i].y);
    return texture.mean_over(uvs);
}

}  // namespace transillum
