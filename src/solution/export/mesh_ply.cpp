// PLY (Turk 1994), binary little endian.
#include "solution/export/mesh_bytes.h"

#include <transillum/base/srgb.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace transillum {

namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
void append(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string mesh_ply(const RadianceMesh& mesh, const std::filesystem::path&) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                        std::to_string(mesh.positions.size()) +
                        "\nproperty double x\nproperty double y\nproperty double z\n"
                        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                        "property float radiance_r\nproperty float radiance_g\n"
                        "property float radiance_b\nelement face " +
                        std::to_string(mesh.triangles.size()) +
                        "\nproperty list uchar uint vertex_indices\nend_header\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        for (int axis = 0; axis < 3; ++axis) append(bytes, mesh.positions[v][axis]);
        for (int c = 0; c < channel_count; ++c)
            append(bytes, static_cast<std::uint8_t>(
                              std::lround(255.0f * srgb_from_linear(mesh.display[v][c]))));
        for (int c = 0; c < channel_count; ++c) append(bytes, mesh.radiance[v][c]);
    }
    for (const RadianceMesh::Triangle& t : mesh.triangles) {
        append(bytes, std::uint8_t{3});
        for (const std::uint32_t v : t.vertices) append(bytes, v);
    }
    return bytes;
}

}  // namespace transillum
