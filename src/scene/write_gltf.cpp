// glTF 2.0: a node with a mesh for each object, with a primitive for each of its materials; then
// nodes with cameras and lights.
#include "scene/gltf_builder.h"
#include "scene/write_gltf_materials.h"

#include <transillum/scene/photometry.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numbers>
#include <unordered_map>

namespace transillum {

namespace {

using Json = GltfBuilder::Json;

constexpr int vertex_target = 34962, index_target = 34963;
constexpr int float_type = 5126, uint_type = 5125;

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Vertices and indices of a primitive; corners alike in position and UV are one vertex.
struct Primitive {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> indices;
};

class PrimitiveBuilder {
public:
    PrimitiveBuilder(const Scene& scene, const std::vector<glm::vec3>& positions)
        : scene_(scene), positions_(positions) {}

    void add(const Polygon& polygon) {
        for (std::uint32_t c = 0; c < 3; ++c)
            primitive_.indices.push_back(vertex_of(polygon.first_corner + c));
    }
    [[nodiscard]] const Primitive& result() const { return primitive_; }

private:
    struct Vertex {
        std::uint32_t position = 0, u = 0, v = 0;  ///< bits of the UV
        bool operator==(const Vertex&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Vertex& v) const {
            std::uint64_t h = std::uint64_t{v.position} * 0x9e3779b97f4a7c15u;
            h ^= (std::uint64_t{v.u} << 32 | v.v) * 0xc2b2ae3d27d4eb4fu;
            return static_cast<std::size_t>(h ^ h >> 29);
        }
    };
    std::uint32_t vertex_of(std::uint32_t corner) {
        const glm::vec2 uv = scene_.uvs.empty() ? glm::vec2(0.0f) : scene_.uvs[corner];
        const Vertex vertex{scene_.corners[corner], std::bit_cast<std::uint32_t>(uv.x),
                            std::bit_cast<std::uint32_t>(uv.y)};
        const auto [found, is_new] = number_of_vertex_.try_emplace(
            vertex, static_cast<std::uint32_t>(primitive_.positions.size()));
        if (is_new) {
            primitive_.positions.push_back(positions_[vertex.position]);
            if (!scene_.uvs.empty()) primitive_.uvs.push_back(uv);
        }
        return found->second;
    }

    const Scene& scene_;
    const std::vector<glm::vec3>& positions_;
    Primitive primitive_;
    std::unordered_map<Vertex, std::uint32_t, Hash> number_of_vertex_;
};

class GltfWriter {
public:
    GltfWriter(const SceneWriter& writer, GltfContainer container)
        : writer_(writer),
          scene_(writer.scene),
          builder_(writer, container),
          positions_(writer.float_positions()) {}

    void write() {
        write_gltf_materials(builder_);
        write_objects();
        write_cameras();
        write_lights();
        writer_.leave_out("environment", scene_.lighting.environment.shines() ? 1 : 0);
        builder_.add("scenes", {{"nodes", nodes_}});
        builder_.finish();
    }

private:
    void add_node(Json node) { nodes_.push_back(builder_.add("nodes", std::move(node))); }
    void write_objects();
    Json primitive_of(const Primitive& primitive, std::uint32_t material);
    void write_cameras();
    void write_lights();

    const SceneWriter& writer_;
    const Scene& scene_;
    GltfBuilder builder_;
    std::vector<glm::vec3> positions_;
    Json nodes_ = Json::array();
};

Json GltfWriter::primitive_of(const Primitive& primitive, std::uint32_t material) {
    const auto accessor = [&](std::string_view bytes, std::size_t count, int component,
                              const char* type, int target) {
        return Json{{"bufferView", builder_.add_view(bytes, target)},
                    {"componentType", component},
                    {"count", count},
                    {"type", type}};
    };
    glm::vec3 low = primitive.positions.front(), high = low;
    for (const glm::vec3& p : primitive.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    Json positions = accessor(bytes_of(primitive.positions), primitive.positions.size(), float_type,
                              "VEC3", vertex_target);
    positions["min"] = {low.x, low.y, low.z};
    positions["max"] = {high.x, high.y, high.z};
    Json json;
    json["attributes"]["POSITION"] = builder_.add("accessors", std::move(positions));
    if (!primitive.uvs.empty())
        json["attributes"]["TEXCOORD_0"] =
            builder_.add("accessors", accessor(bytes_of(primitive.uvs), primitive.uvs.size(),
                                               float_type, "VEC2", vertex_target));
    json["indices"] =
        builder_.add("accessors", accessor(bytes_of(primitive.indices), primitive.indices.size(),
                                           uint_type, "SCALAR", index_target));
    json["material"] = material;
    return json;
}

void GltfWriter::write_objects() {
    const std::vector<std::uint32_t> order = writer_.polygons_by_object();
    std::size_t written = 0;
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end, ++written) {
        const std::uint32_t object = scene_.polygons[order[begin]].object;
        std::vector<std::uint32_t> materials;  // as they come
        std::unordered_map<std::uint32_t, PrimitiveBuilder> primitives;
        for (; end < order.size() && scene_.polygons[order[end]].object == object; ++end) {
            const Polygon& polygon = scene_.polygons[order[end]];
            const auto [found, is_new] =
                primitives.try_emplace(polygon.material, scene_, positions_);
            if (is_new) materials.push_back(polygon.material);
            found->second.add(polygon);
        }
        Json list = Json::array();
        for (const std::uint32_t m : materials)
            list.push_back(primitive_of(primitives.at(m).result(), m));
        const std::size_t mesh = builder_.add("meshes", {{"primitives", std::move(list)}});
        add_node({{"name", scene_.objects[object]}, {"mesh", mesh}});
    }
    writer_.leave_out("objects without polygons", scene_.objects.size() - written);
}

/// What looks along -z and has +y up, at a place.
Json matrix_of(const glm::dvec3& place, const glm::dvec3& direction, const glm::dvec3& up) {
    const glm::dvec3 z = -glm::normalize(direction);
    glm::dvec3 x = glm::cross(up, z);
    // Where `up` is along the direction, any other will do.
    if (!(glm::length(x) > 1e-12 * glm::length(up)))
        x = glm::cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z);
    x = glm::normalize(x);
    const glm::dvec3 y = glm::cross(z, x);
    Json matrix = Json::array();
    for (const glm::dvec3& column : {x, y, z, place}) {
        for (int row = 0; row < 3; ++row) matrix.push_back(column[row]);
        matrix.push_back(matrix.size() == 15 ? 1 : 0);
    }
    return matrix;
}

void GltfWriter::write_cameras() {
    for (const Camera& camera : scene_.cameras) {
        const std::size_t index = builder_.add(
            "cameras",
            {{"type", "perspective"},
             {"perspective", {{"yfov", glm::radians(camera.vertical_fov)}, {"znear", 0.01}}}});
        add_node({{"name", camera.name},
                  {"camera", index},
                  {"matrix", matrix_of(camera.eye, camera.look_at - camera.eye, camera.up)}});
    }
}

Json light_of(const PunctualLight& light) {
    using Kind = PunctualLight::Kind;
    Spectrum intensity = light.intensity;
    Kind kind = light.kind;
    if (light.photometry) {
        kind = Kind::point;
        intensity = Spectrum(light.flux() / (4.0 * std::numbers::pi));
    }
    const double largest = static_cast<double>(max_channel(intensity));
    Json json;
    json["type"] = kind == Kind::point ? "point" : kind == Kind::spot ? "spot" : "directional";
    for (int c = 0; c < channel_count; ++c)
        json["color"].push_back(largest > 0.0 ? static_cast<double>(intensity[c]) / largest : 1.0);
    json["intensity"] = largest;
    if (kind == Kind::spot)
        json["spot"] = {{"innerConeAngle", light.inner_angle},
                        {"outerConeAngle", light.outer_angle}};
    return json;
}

void GltfWriter::write_lights() {
    constexpr const char* extension = "KHR_lights_punctual";
    std::size_t photometric = 0;
    for (const PunctualLight& light : scene_.lighting.lights) {
        Json& lights = builder_.extension(extension)["lights"];
        lights.push_back(light_of(light));
        photometric += light.photometry != nullptr;
        Json node{{"name", light.name},
                  {"matrix", matrix_of(light.position, light.direction, light.up)}};
        node["extensions"][extension]["light"] = lights.size() - 1;
        add_node(std::move(node));
    }
    if (photometric > 0)
        writer_.monitor.warn(writer_.files.main().string() + ": glTF holds no photometry; " +
                             std::to_string(photometric) +
                             " lights become points of the same flux");
}

}  // namespace

void write_gltf(const SceneWriter& writer) {
    GltfWriter(writer, GltfContainer::json).write();
}

void write_glb(const SceneWriter& writer) {
    GltfWriter(writer, GltfContainer::binary).write();
}

}  // namespace transillum
