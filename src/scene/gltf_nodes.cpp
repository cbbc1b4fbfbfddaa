#include "scene/gltf_nodes.h"

#include "scene/text_reader.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace transillum {

namespace {

template <std::size_t N>
std::array<double, N> numbers(const GltfDocument& document, const std::string& place,
                              const Json& node, const char* key,
                              const std::array<double, N>& fallback) {
    const auto found = node.find(key);
    if (found == node.end()) return fallback;
    if (!found->is_array() || found->size() != N)
        document.fail(place, std::string(key) + " is " + in_quotes(found->dump()) +
                                 "; accepted: " + std::to_string(N) + " numbers");
    return found->get<std::array<double, N>>();
}

glm::dmat4 parent_from_node(const GltfDocument& document, std::size_t index) {
    const Json& node = document.root().at("nodes")[index];
    const std::string place = place_of("nodes", index);
    if (node.contains("matrix"))
        return glm::make_mat4(numbers<16>(document, place, node, "matrix", {}).data());
    const auto t = numbers<3>(document, place, node, "translation", {0, 0, 0});
    const auto r = numbers<4>(document, place, node, "rotation", {0, 0, 0, 1});
    const auto s = numbers<3>(document, place, node, "scale", {1, 1, 1});
    const glm::dquat rotation(r[3], r[0], r[1], r[2]);
    if (!(glm::length(rotation) > 0.0))
        document.fail(place, "rotation is zero; accepted: a unit quaternion");
    glm::dmat4 m = glm::mat4_cast(glm::normalize(rotation));
    for (int axis = 0; axis < 3; ++axis) m[axis] *= s[static_cast<std::size_t>(axis)];
    m[3] = glm::dvec4(t[0], t[1], t[2], 1.0);
    return m;
}

/// The default scene's roots; without scenes, every node that is no other's child.
std::vector<std::size_t> find_roots(const GltfDocument& document) {
    std::vector<std::size_t> roots;
    if (document.count("scenes") > 0) {
        const Json first = 0u;
        const auto chosen = document.root().find("scene");
        const Json& scene =
            document.element("scenes", chosen == document.root().end() ? first : *chosen);
        if (!scene.contains("nodes")) return roots;
        for (const Json& node : scene.at("nodes"))
            roots.push_back(document.index_into("nodes", node));
        return roots;
    }
    std::vector<bool> is_child(document.count("nodes"), false);
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (const Json& node = document.root().at("nodes")[i]; node.contains("children"))
            for (const Json& child : node.at("children"))
                is_child[document.index_into("nodes", child)] = true;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) roots.push_back(i);
    return roots;
}

void check_finite(const GltfDocument& document, const GltfNode& node) {
    const double* values = glm::value_ptr(node.world_from_node);
    if (!std::all_of(values, values + 16, [](double v) { return std::isfinite(v); }))
        document.fail(place_of("nodes", node.index),
                      "transform is not finite; accepted: finite numbers");
}

}  // namespace

std::vector<GltfNode> flatten_nodes(const GltfDocument& document) {
    std::vector<GltfNode> nodes;
    std::vector<bool> visited(document.count("nodes"), false);
    const auto visit = [&](std::size_t index, const glm::dmat4& world_from_parent) {
        if (visited[index])
            document.fail(place_of("nodes", index),
                          "has two parents or is its own ancestor; accepted: a tree");
        visited[index] = true;
        nodes.push_back({index, world_from_parent * parent_from_node(document, index)});
        check_finite(document, nodes.back());
    };
    for (const std::size_t root : find_roots(document)) visit(root, glm::dmat4(1.0));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Json& node = document.root().at("nodes")[nodes[i].index];
        if (!node.contains("children")) continue;
        const glm::dmat4 world_from_node = nodes[i].world_from_node;
        for (const Json& child : node.at("children"))
            visit(document.index_into("nodes", child), world_from_node);
    }
    return nodes;
}

}  // namespace transillum
