// Binary STL: a header of 80 bytes, the number of facets, and 50 bytes a facet.
#include "scene/scene_writer.h"

#include <glm/geometric.hpp>

#include <array>
#include <bit>
#include <cstring>

namespace transillum {

namespace {

static_assert(std::endian::native == std::endian::little);

/// Unit, or 0 where there is none: readers then take it from the corners.
glm::vec3 facet_normal(const std::array<glm::vec3, 3>& p) {
    const glm::dvec3 a(p[0]);
    const glm::dvec3 n = glm::cross(glm::dvec3(p[1]) - a, glm::dvec3(p[2]) - a);
    const double length = glm::length(n);
    return length > 0.0 ? glm::vec3(n / length) : glm::vec3(0.0f);
}

void append(std::string& bytes, const glm::vec3& v) {
    for (int axis = 0; axis < 3; ++axis) {
        const float value = v[axis];
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
}

}  // namespace

void write_stl(const SceneWriter& writer) {
    const Scene& scene = writer.scene;
    writer.leave_out_all_but_geometry();
    const std::vector<glm::vec3> positions = writer.float_positions();
    // "solid" would begin a text file.
    std::string bytes = "binary STL";
    bytes.resize(80, ' ');
    const auto facets = static_cast<std::uint32_t>(scene.polygons.size());
    bytes.append(reinterpret_cast<const char*>(&facets), sizeof facets);
    for (const std::uint32_t p : writer.polygons_by_object()) {
        const std::uint32_t* corners = scene.corners.data() + scene.polygons[p].first_corner;
        const std::array<glm::vec3, 3> facet{positions[corners[0]], positions[corners[1]],
                                             positions[corners[2]]};
        append(bytes, facet_normal(facet));
        for (const glm::vec3& corner : facet) append(bytes, corner);
        bytes.append(2, '\0');
    }
    writer.files.write_main(bytes);
}

}  // namespace transillum
