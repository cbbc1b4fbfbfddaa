// PLY (Turk 1994), binary little endian, coordinates in double precision.
#include "scene/scene_writer.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace transillum {

namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
void append(std::string& bytes, T value) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof value);
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace

void write_ply(const SceneWriter& writer) {
    const Scene& scene = writer.scene;
    writer.leave_out_all_but_geometry();
    const bool few_corners =
        std::ranges::all_of(scene.polygons, [](const Polygon& p) { return p.corner_count < 256; });
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                        std::to_string(scene.positions.size()) +
                        "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                        std::to_string(scene.polygons.size()) + "\nproperty list " +
                        (few_corners ? "uchar" : "uint") + " uint vertex_indices\nend_header\n";
    for (const glm::dvec3& p : scene.positions)
        for (int axis = 0; axis < 3; ++axis) append(bytes, p[axis]);
    for (const std::uint32_t p : writer.polygons_by_object()) {
        const Polygon& polygon = scene.polygons[p];
        if (few_corners) {
            append(bytes, static_cast<std::uint8_t>(polygon.corner_count));
        } else {
            append(bytes, polygon.corner_count);
        }
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c)
            append(bytes, scene.corners[polygon.first_corner + c]);
    }
    writer.files.write_main(bytes);
}

}  // namespace transillum
