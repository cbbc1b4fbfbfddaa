#include "scene/gltf_lights.h"

#include "scene/soup.h"
#include "scene/text_reader.h"

#include <glm/geometric.hpp>

#include <array>
#include <numbers>

namespace transillum {

namespace {

constexpr const char* extension = "KHR_lights_punctual";

const Json* extension_of(const Json& object) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end()) return nullptr;
    const auto found = extensions->find(extension);
    return found == extensions->end() ? nullptr : &*found;
}

/// The element of the extension's own array that a node names.
const Json& named_light(const GltfDocument& document, const Json& index) {
    const Json* root = extension_of(document.root());
    const std::size_t count = root && root->contains("lights") && root->at("lights").is_array()
                                  ? root->at("lights").size()
                                  : 0;
    if (!index.is_number_unsigned() || index.get<std::size_t>() >= count)
        document.fail(std::string(extension) + " lights",
                      "element " + in_quotes(index.dump()) + " is named of " +
                          std::to_string(count) + "; accepted: " + index_range(count));
    return root->at("lights")[index.get<std::size_t>()];
}

PunctualLight::Kind kind_of(const GltfDocument& document, const std::string& place,
                            const Json& json) {
    const auto type = json.at("type").get<std::string>();
    if (type == "point") return PunctualLight::Kind::point;
    if (type == "spot") return PunctualLight::Kind::spot;
    if (type != "directional")
        document.fail(place, "type " + in_quotes(type) + "; accepted: point, spot, directional");
    return PunctualLight::Kind::directional;
}

Spectrum intensity_of(const GltfDocument& document, const std::string& place, const Json& json) {
    const auto colour = json.value("color", std::array<double, 3>{1.0, 1.0, 1.0});
    const double intensity = json.value("intensity", 1.0);
    Spectrum result;
    for (int c = 0; c < channel_count; ++c) {
        const double value = colour[static_cast<std::size_t>(c)] * intensity;
        result[c] = static_cast<float>(value);
        if (!(value >= 0.0 && std::isfinite(result[c])))
            document.fail(place, "intensity times color is " + shown(value) +
                                     "; accepted: 0 or more, finite");
    }
    return result;
}

void read_cone(const GltfDocument& document, const std::string& place, const Json& json,
               PunctualLight& light) {
    const Json cone = json.value("spot", Json::object());
    light.inner_angle = cone.value("innerConeAngle", 0.0);
    light.outer_angle = cone.value("outerConeAngle", std::numbers::pi / 4.0);
    // Files round their angles to single precision.
    const double most = std::numbers::pi / 2.0 * (1.0 + 1e-6);
    if (!(light.inner_angle >= 0.0 && light.inner_angle < light.outer_angle &&
          light.outer_angle <= most))
        document.fail(place, "cone angles " + shown(light.inner_angle) + " and " +
                                 shown(light.outer_angle) +
                                 " radians; accepted: 0 <= inner < outer <= pi / 2");
}

}  // namespace

void read_gltf_light(const GltfDocument& document, const GltfNode& node,
                     std::vector<PunctualLight>& lights, Monitor& monitor) {
    const Json& json = document.root().at("nodes")[node.index];
    const Json* reference = extension_of(json);
    if (reference == nullptr) return;
    const Json& source = named_light(document, reference->at("light"));
    const std::string place = std::string(extension) + " " +
                              place_of("lights", reference->at("light").get<std::size_t>());
    PunctualLight light;
    light.name =
        json.value("name", source.value("name", "light " + std::to_string(lights.size() + 1)));
    light.kind = kind_of(document, place, source);
    light.intensity = intensity_of(document, place, source);
    if (light.kind == PunctualLight::Kind::spot) read_cone(document, place, source, light);
    const glm::dmat4& m = node.world_from_node;
    const glm::dvec3 forward = -glm::dvec3(m[2]), up = glm::dvec3(m[1]);
    if (!(glm::length(forward) > 0.0 && glm::length(up) > 0.0))
        document.fail(place_of("nodes", node.index),
                      "its light has no direction; accepted: a transform of rank 3");
    light.position = glm::dvec3(m[3]);
    light.direction = glm::normalize(forward);
    light.up = glm::normalize(up);
    if (source.contains("range"))
        monitor.note(document.where() + ": not honoured: range of light " + in_quotes(light.name) +
                     " (light fades with the square of the distance alone)");
    lights.push_back(std::move(light));
}

}  // namespace transillum
