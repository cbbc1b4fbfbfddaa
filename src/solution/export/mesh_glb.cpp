// glTF 2.0 with KHR_materials_unlit: a viewer shows COLOR_0 and lights nothing.
#include "solution/export/mesh_bytes.h"

#include <transillum/base/glb.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

namespace transillum {

namespace {

using Json = nlohmann::json;
constexpr int vertex_target = 34962, index_target = 34963;
constexpr int float_type = 5126, uint_type = 5125;

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-low};
};

Box box_of(const RadianceMesh& mesh) {
    Box box;
    for (const glm::dvec3& p : mesh.positions) {
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
    }
    return box;
}

class GlbWriter {
public:
    explicit GlbWriter(const RadianceMesh& mesh)
        : mesh_(mesh), numbers_(mesh.positions.size(), none) {
        const Box box = box_of(mesh);
        middle_ = 0.5 * (box.low + box.high);
    }

    std::string write(const std::filesystem::path& file) {
        Json children = Json::array();
        const auto& triangles = mesh_.triangles;
        for (auto begin = triangles.begin(), end = begin; begin != triangles.end(); begin = end) {
            const std::uint32_t object = begin->object;
            end = std::find_if(begin, triangles.end(),
                               [&](const auto& t) { return t.object != object; });
            add("meshes", {{"name", mesh_.objects[object]},
                           {"primitives", Json::array({primitive({begin, end})})}});
            children.push_back(add(
                "nodes", {{"name", mesh_.objects[object]}, {"mesh", root_["meshes"].size() - 1}}));
        }
        const std::size_t top = add("nodes", {{"name", "transillum"},
                                              {"translation", {middle_.x, middle_.y, middle_.z}},
                                              {"children", std::move(children)}});
        add("scenes", {{"nodes", {top}}});
        root_["scene"] = 0;
        root_["asset"] = {{"version", "2.0"},
                          {"generator", "transillum"},
                          {"extras", {{"exposure", mesh_.exposure}}}};
        Json material{{"name", "radiance"},
                      {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
        if (has_lightmap()) add_lightmap(material);
        root_["materials"] = {std::move(material)};
        root_["extensionsUsed"] = {"KHR_materials_unlit"};
        root_["buffers"] = {{{"byteLength", bytes_.size()}}};
        // Names from other formats may be in another encoding than UTF-8.
        return glb_bytes(root_.dump(-1, ' ', false, Json::error_handler_t::replace),
                         std::move(bytes_), file);
    }

private:
    static constexpr std::uint32_t none = 0xffffffffu;
    using Triangles = std::pair<std::vector<RadianceMesh::Triangle>::const_iterator,
                                std::vector<RadianceMesh::Triangle>::const_iterator>;

    std::size_t add(const char* array, Json element) {
        root_[array].push_back(std::move(element));
        return root_[array].size() - 1;
    }

    [[nodiscard]] bool has_lightmap() const { return !mesh_.lightmap_uvs.empty(); }

    std::size_t view_of(std::string_view bytes) {
        const std::size_t offset = bytes_.size();
        bytes_ += bytes;
        bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');  // accessors begin at multiples of 4
        return add("bufferViews",
                   {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
    }

    /// Linear filtering without mip levels, which would mix charts.
    void add_lightmap(Json& material) {
        constexpr int linear = 9729, clamp_to_edge = 33071;
        root_["samplers"] = {{{"magFilter", linear},
                              {"minFilter", linear},
                              {"wrapS", clamp_to_edge},
                              {"wrapT", clamp_to_edge}}};
        root_["images"] = {{{"name", "lightmap"},
                            {"mimeType", "image/png"},
                            {"bufferView", view_of(mesh_.lightmap_png)}}};
        root_["textures"] = {{{"sampler", 0}, {"source", 0}}};
        material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}, {"texCoord", 1}};
    }

    template <class Value>
    std::size_t accessor(const std::vector<Value>& values, std::size_t count, int component,
                         const char* type, int target, Json bounds = Json::object()) {
        const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                                     values.size() * sizeof(Value));
        const std::size_t view = view_of(bytes);
        root_["bufferViews"][view]["target"] = target;
        bounds.update(
            {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
        return add("accessors", std::move(bounds));
    }

    Json primitive(const Triangles& triangles) {
        std::vector<std::uint32_t> vertices, indices;
        for (auto t = triangles.first; t != triangles.second; ++t)
            for (const std::uint32_t v : t->vertices) {
                if (numbers_[v] == none) {
                    numbers_[v] = static_cast<std::uint32_t>(vertices.size());
                    vertices.push_back(v);
                }
                indices.push_back(numbers_[v]);
            }
        std::vector<glm::vec3> positions, colours;
        std::vector<glm::vec2> uvs, lightmap_uvs;
        for (const std::uint32_t v : vertices) {
            numbers_[v] = none;
            positions.emplace_back(mesh_.positions[v] - middle_);
            if (!has_lightmap()) {
                colours.push_back(mesh_.display[v]);
                continue;
            }
            lightmap_uvs.push_back(mesh_.lightmap_uvs[v]);
            uvs.push_back(mesh_.uvs.empty() ? mesh_.lightmap_uvs[v] : mesh_.uvs[v]);
        }
        glm::vec3 low = positions.front(), high = low;
        for (const glm::vec3& p : positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const std::size_t count = positions.size();
        const Json bounds{{"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}};
        Json attributes;
        attributes["POSITION"] =
            accessor(positions, count, float_type, "VEC3", vertex_target, bounds);
        if (has_lightmap()) {
            attributes["TEXCOORD_0"] = accessor(uvs, count, float_type, "VEC2", vertex_target);
            attributes["TEXCOORD_1"] =
                accessor(lightmap_uvs, count, float_type, "VEC2", vertex_target);
        } else {
            attributes["COLOR_0"] = accessor(colours, count, float_type, "VEC3", vertex_target);
        }
        return {{"attributes", std::move(attributes)},
                {"indices", accessor(indices, indices.size(), uint_type, "SCALAR", index_target)},
                {"material", 0}};
    }

    const RadianceMesh& mesh_;
    glm::dvec3 middle_{0.0};
    std::vector<std::uint32_t> numbers_;  ///< of vertices in the primitive at hand
    Json root_;
    std::string bytes_;
};

}  // namespace

std::string mesh_glb(const RadianceMesh& mesh, const std::filesystem::path& file) {
    return GlbWriter(mesh).write(file);
}

}  // namespace transillum
