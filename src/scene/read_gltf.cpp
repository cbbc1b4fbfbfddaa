#include "scene/read_gltf.h"

#include "scene/gltf_document.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_textures.h"
#include "scene/scene_textures.h"
#include "scene/soup.h"
#include "scene/text_reader.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace transillum {

namespace {

const Json& member_or_null(const Json& object, const char* key) {
    static const Json null;
    const auto found = object.find(key);
    return found == object.end() ? null : *found;
}

class GltfReader {
public:
    GltfReader(const std::filesystem::path& path, Monitor& monitor)
        : document_(path), textures_(document_, monitor), monitor_(monitor) {
        scene_.path = path.string();
    }
    Scene read();

private:
    void check_extensions();
    void check_size(const std::vector<GltfNode>& nodes) const;
    void read_node(const GltfNode& node);
    void read_camera(const GltfNode& node, const Json& json);
    void read_primitive(const GltfNode& node, const std::string& place, const Json& primitive);
    std::uint32_t material_of(const Json& primitive);
    std::vector<std::uint32_t> read_indices(const std::string& place, const Json& primitive,
                                            std::size_t vertices) const;
    void read_positions(const GltfNode& node, const GltfAccessor& positions,
                        const std::string& place);
    void apply_textures();

    GltfDocument document_;
    GltfTextures textures_;
    Monitor& monitor_;
    Scene scene_;
    std::uint32_t default_material_ = std::numeric_limits<std::uint32_t>::max();
    std::set<std::string> left_out_;
    std::vector<std::uint8_t> has_uvs_;  ///< one a polygon
};

void GltfReader::check_extensions() {
    constexpr std::array<std::string_view, 7> honoured{
        "KHR_lights_punctual",    "KHR_materials_emissive_strength", "KHR_materials_ior",
        "KHR_materials_specular", "KHR_materials_transmission",      "KHR_mesh_quantization",
        "KHR_texture_transform"};
    std::string accepted;
    for (const std::string_view name : honoured)
        accepted.append(accepted.empty() ? "" : ", ").append(name);
    const auto is_honoured = [&](const Json& name) {
        return std::ranges::count(honoured, name.get<std::string>()) > 0;
    };
    for (const Json& name : document_.root().value("extensionsRequired", Json::array()))
        if (!is_honoured(name))
            document_.fail("extensionsRequired",
                           in_quotes(name.get<std::string>()) + " found; accepted: " + accepted);
    for (const Json& name : document_.root().value("extensionsUsed", Json::array()))
        if (!is_honoured(name)) left_out_.insert("extension " + name.get<std::string>());
    for (const char* array : {"skins", "animations"})
        if (document_.count(array) > 0) left_out_.insert(array);
}

std::uint32_t GltfReader::material_of(const Json& primitive) {
    if (primitive.contains("material"))
        return static_cast<std::uint32_t>(
            document_.index_into("materials", primitive.at("material")));
    if (default_material_ == std::numeric_limits<std::uint32_t>::max()) {
        default_material_ = static_cast<std::uint32_t>(scene_.materials.size());
        Material m = named_material("default");
        // glTF: white, fully metallic, single-sided
        m.diffuse = Spectrum(0.0f);
        m.specular = Spectrum(1.0f);
        m.lobe = Lobe::ggx;
        m.back_reflects = false;
        scene_.materials.push_back(m);
    }
    return default_material_;
}

/// Turns a strip or fan (modes 5 and 6) into triangles.
std::vector<std::uint32_t> unroll(const std::vector<std::uint32_t>& run, bool is_fan) {
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 0; i + 2 < run.size(); ++i) {
        const bool odd = i % 2 == 1;
        const std::array<std::size_t, 3> corners =
            is_fan ? std::array{i + 1, i + 2, std::size_t{0}}
                   : std::array{i, i + (odd ? 2 : 1), i + (odd ? 1 : 2)};
        for (const std::size_t c : corners) triangles.push_back(run[c]);
    }
    return triangles;
}

std::vector<std::uint32_t> GltfReader::read_indices(const std::string& place, const Json& primitive,
                                                    std::size_t vertices) const {
    std::vector<std::uint32_t> indices;
    if (primitive.contains("indices")) {
        const GltfAccessor values = document_.accessor(primitive.at("indices"), "SCALAR");
        if (values.component_type == 5126 || values.normalized)
            document_.fail(place, "indices are no whole numbers");
        indices.reserve(values.count);
        for (std::size_t i = 0; i < values.count; ++i) {
            const double index = values.value(i, 0);
            if (!(index >= 0.0 && index < static_cast<double>(vertices)))
                document_.fail(place, "face " + std::to_string(i / 3) + " names vertex " +
                                          shown(index) + " of " + std::to_string(vertices) +
                                          "; accepted: " + index_range(vertices));
            indices.push_back(static_cast<std::uint32_t>(index));
        }
    } else {
        indices.resize(vertices);
        std::iota(indices.begin(), indices.end(), 0u);
    }
    const std::size_t mode = size_value(document_, primitive, "mode", 4);
    if (mode == 5 || mode == 6) return unroll(indices, mode == 6);
    if (indices.size() % 3 != 0)
        document_.fail(place,
                       std::to_string(indices.size()) + " indices; accepted: a multiple of 3");
    return indices;
}

void GltfReader::read_positions(const GltfNode& node, const GltfAccessor& positions,
                                const std::string& place) {
    if (scene_.positions.size() + positions.count > std::numeric_limits<std::uint32_t>::max())
        document_.fail(place, "more than 4294967295 vertices; accepted: fewer");
    for (std::size_t i = 0; i < positions.count; ++i) {
        const glm::dvec4 p(positions.value(i, 0), positions.value(i, 1), positions.value(i, 2),
                           1.0);
        scene_.positions.emplace_back(node.world_from_node * p);
        if (!is_finite(scene_.positions.back()))
            document_.fail(place,
                           "vertex " + std::to_string(i) +
                               " has a coordinate that is not finite; accepted: finite numbers");
    }
}

void GltfReader::read_primitive(const GltfNode& node, const std::string& place,
                                const Json& primitive) {
    const std::size_t mode = size_value(document_, primitive, "mode", 4);
    if (mode > 6) document_.fail(place, "mode " + std::to_string(mode) + "; accepted: 0 to 6");
    if (mode < 4) {
        left_out_.insert("points and lines");
        return;
    }
    const Json& attributes = primitive.at("attributes");
    if (attributes.contains("COLOR_0")) left_out_.insert("vertex colours");
    if (primitive.contains("targets")) left_out_.insert("morph targets");

    const GltfAccessor positions = document_.accessor(attributes.at("POSITION"), "VEC3");
    const TextureFrame frame =
        primitive.contains("material")
            ? textures_.frame_of(document_.index_into("materials", primitive.at("material")))
            : TextureFrame{};
    const std::string uv_set = "TEXCOORD_" + std::to_string(frame.set);
    const bool has_uvs = attributes.contains(uv_set);
    const GltfAccessor uvs =
        has_uvs ? document_.accessor(attributes.at(uv_set), "VEC2") : GltfAccessor{};
    if (has_uvs && uvs.count != positions.count)
        document_.fail(place, std::to_string(uvs.count) +
                                  " texture coordinates; accepted: one for each of " +
                                  std::to_string(positions.count) + " vertices");
    std::vector<std::uint32_t> indices = read_indices(place, primitive, positions.count);
    // A mirroring transform turns the corners round; glTF keeps the front where it was.
    if (glm::determinant(glm::dmat3(node.world_from_node)) < 0.0)
        for (std::size_t i = 0; i < indices.size(); i += 3)
            std::swap(indices[i + 1], indices[i + 2]);

    const auto offset = static_cast<std::uint32_t>(scene_.positions.size());
    const std::uint32_t material = material_of(primitive);
    read_positions(node, positions, place);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        scene_.corners.push_back(offset + indices[i]);
        scene_.uvs.push_back(has_uvs
                                 ? frame.apply({uvs.value(indices[i], 0), uvs.value(indices[i], 1)})
                                 : glm::vec2(0.0f));
        if (i % 3 < 2) continue;
        close_polygon(scene_, scene_.corners.size() - 3, material,
                      static_cast<std::uint32_t>(scene_.objects.size() - 1));
        has_uvs_.push_back(has_uvs);
    }
}

void GltfReader::read_camera(const GltfNode& node, const Json& json) {
    const std::size_t index = document_.index_into("cameras", json.at("camera"));
    const Json& camera = document_.root().at("cameras")[index];
    const std::string place = place_of("cameras", index);
    if (camera.at("type").get<std::string>() != "perspective") {
        left_out_.insert("orthographic cameras");
        return;
    }
    Camera result;
    result.name = json.value("name", camera.value("name", "camera " + std::to_string(index)));
    const glm::dmat4& m = node.world_from_node;
    const glm::dvec3 forward = -glm::dvec3(m[2]), up = glm::dvec3(m[1]);
    if (glm::length(forward) == 0.0 || glm::length(up) == 0.0)
        document_.fail(place_of("nodes", node.index),
                       "its camera has no direction; accepted: a transform of rank 3");
    result.eye = glm::dvec3(m[3]);
    result.look_at = result.eye + glm::normalize(forward);
    result.up = glm::normalize(up);
    result.vertical_fov = glm::degrees(camera.at("perspective").at("yfov").get<double>());
    if (!(result.vertical_fov > 0.0 && result.vertical_fov < 180.0))
        document_.fail(place, "yfov is " + shown(result.vertical_fov) +
                                  " degrees; accepted: between 0 and 180");
    scene_.cameras.push_back(result);
}

void GltfReader::read_node(const GltfNode& node) {
    const Json& json = document_.root().at("nodes")[node.index];
    if (json.contains("camera")) read_camera(node, json);
    read_gltf_light(document_, node, scene_.lighting.lights, monitor_);
    if (!json.contains("mesh")) return;
    const std::size_t index = document_.index_into("meshes", json.at("mesh"));
    const Json& mesh = document_.root().at("meshes")[index];
    scene_.objects.push_back(
        json.value("name", mesh.value("name", "node " + std::to_string(node.index))));
    std::size_t number = 0;
    for (const Json& primitive : mesh.at("primitives"))
        read_primitive(node, place_of("meshes", index) + "/" + place_of("primitives", number++),
                       primitive);
}

/// Nodes may share meshes, and primitives accessors, so that a small file can ask for more than any
/// memory holds.
void GltfReader::check_size(const std::vector<GltfNode>& nodes) const {
    constexpr double most = 3.0 * (1 << 25);
    const auto corners_of_mesh = [&](std::size_t index) {
        double corners = 0.0;
        for (const Json& primitive : document_.root().at("meshes")[index].at("primitives")) {
            const Json& attributes = primitive.at("attributes");
            for (const Json* accessor :
                 {&member_or_null(primitive, "indices"), &member_or_null(attributes, "POSITION")})
                if (!accessor->is_null()) {
                    const auto count = static_cast<double>(size_value(
                        document_, document_.element("accessors", *accessor), "count", 0));
                    // One alone is no larger than the file, or refused when it is read.
                    if (count <= most) corners += count;
                }
        }
        return corners;
    };
    std::map<std::size_t, double> of_mesh;
    double corners = 0.0;
    for (const GltfNode& node : nodes) {
        const Json& json = document_.root().at("nodes")[node.index];
        if (!json.contains("mesh")) continue;
        const std::size_t mesh = document_.index_into("meshes", json.at("mesh"));
        const auto [found, is_new] = of_mesh.try_emplace(mesh, 0.0);
        if (is_new) found->second = corners_of_mesh(mesh);
        corners += found->second;
        if (corners > most)
            document_.fail(place_of("nodes", node.index),
                           "more than " + shown(most) +
                               " vertices and indices up to it, each counted as often as nodes "
                               "show it; accepted: fewer");
    }
}

void GltfReader::apply_textures() {
    std::vector<bool> used(scene_.materials.size(), false);
    for (const Polygon& polygon : scene_.polygons) used[polygon.material] = true;
    for (std::size_t i = 0; i < document_.count("materials"); ++i)
        if (used[i]) textures_.apply(i, read_gltf_reflection(document_, i), scene_);
    for (std::size_t i = 0; i < document_.count("textures"); ++i) {
        const Json& texture = document_.root().at("textures")[i];
        if (texture.contains("source") &&
            size_value(document_, texture, "source", 0) >= document_.count("images"))
            monitor_.note(scene_.path + ": " + place_of("textures", i) +
                          " has an image that is not there; no material used needs it");
    }
}

Scene GltfReader::read() {
    check_extensions();
    scene_.materials = read_gltf_materials(document_, monitor_);
    const std::vector<GltfNode> nodes = flatten_nodes(document_);
    check_size(nodes);
    for (const GltfNode& node : nodes) read_node(node);
    if (std::ranges::count(has_uvs_, 1) == 0) scene_.uvs.clear();
    apply_textures();
    finish_textures(scene_, has_uvs_, monitor_);
    for (const std::string& what : left_out_)
        monitor_.note(scene_.path + ": not honoured: " + what);
    return std::move(scene_);
}

}  // namespace

Scene read_gltf(const std::filesystem::path& path, Monitor& monitor) {
    try {
        return GltfReader(path, monitor).read();
    } catch (const Json::exception& error) {
        throw InputError(path.string(), in_quotes(error.what()) + " found; accepted: glTF 2.0");
    }
}

}  // namespace transillum
