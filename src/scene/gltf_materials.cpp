#include "scene/gltf_materials.h"

#include "scene/soup.h"
#include "scene/text_reader.h"

#include <glm/vec4.hpp>

#include <array>
#include <limits>

namespace transillum {

namespace {

constexpr double unbounded = std::numeric_limits<float>::max();

/// A JSON object under a key, or an empty one.
const Json& object_or_empty(const Json& parent, const char* key) {
    static const Json empty = Json::object();
    const auto found = parent.find(key);
    return found == parent.end() ? empty : *found;
}

/// The factors of one material, each checked against its range.
class Factors {
public:
    Factors(const GltfDocument& document, std::string place)
        : document_(document), place_(std::move(place)) {}

    float scalar(const Json& object, const char* key, double fallback, double most) const {
        return check(object.value(key, fallback), key, most);
    }
    template <int N>
    glm::vec<N, float> vector(const Json& object, const char* key, double fallback,
                              double most) const {
        glm::vec<N, float> v(static_cast<float>(fallback));
        const auto found = object.find(key);
        if (found == object.end()) return v;
        if (!found->is_array() || found->size() != N)
            document_.fail(place_, std::string(key) + " is " + in_quotes(found->dump()) +
                                       "; accepted: " + std::to_string(N) + " numbers");
        for (int i = 0; i < N; ++i)
            v[i] = check((*found)[static_cast<std::size_t>(i)].get<double>(), key, most);
        return v;
    }

private:
    float check(double value, const char* key, double most) const {
        if (!(value >= 0.0 && value <= most))
            document_.fail(place_, std::string(key) + " has " + shown(value) + "; accepted: 0 " +
                                       (most == unbounded ? "or more" : "to " + shown(most)));
        return static_cast<float>(value);
    }
    const GltfDocument& document_;
    std::string place_;
};

std::string place_of_material(std::size_t index, const std::string& name) {
    return place_of("materials", index) + " " + in_quotes(name);
}

/// Of a dielectric along the normal: Fresnel's, by KHR_materials_ior, times the factors of
/// KHR_materials_specular.
Spectrum dielectric_reflectance(const Factors& factors, const Json& extensions) {
    const Json& specular = object_or_empty(extensions, "KHR_materials_specular");
    const float ior =
        factors.scalar(object_or_empty(extensions, "KHR_materials_ior"), "ior", 1.5, unbounded);
    const float root = (ior - 1.0f) / (ior + 1.0f);
    const Spectrum colour = factors.vector<3>(specular, "specularColorFactor", 1.0, unbounded);
    return factors.scalar(specular, "specularFactor", 1.0, 1.0) *
           glm::min(root * root * colour, Spectrum(1.0f));
}

Material read_material(const GltfDocument& document, std::size_t index, Monitor& monitor) {
    const Json& json = document.root().at("materials")[index];
    Material m = named_material(json.value("name", "material " + std::to_string(index)));
    const std::string place = place_of_material(index, m.name);
    const Factors factors(document, place);
    const Json& extensions = object_or_empty(json, "extensions");
    const Json& pbr = object_or_empty(json, "pbrMetallicRoughness");

    const glm::vec4 base = factors.vector<4>(pbr, "baseColorFactor", 1.0, 1.0);
    const float metallic = factors.scalar(pbr, "metallicFactor", 1.0, 1.0);
    const GltfReflection reflection{dielectric_reflectance(factors, extensions)};
    m.diffuse = reflection.diffuse(Spectrum(base), metallic);
    m.specular = reflection.specular(Spectrum(base), metallic);
    m.lobe = max_channel(m.specular) > 0.0f ? Lobe::ggx : Lobe::none;
    m.roughness = factors.scalar(pbr, "roughnessFactor", 1.0, 1.0);

    const float specular_factor = factors.scalar(
        object_or_empty(extensions, "KHR_materials_specular"), "specularFactor", 1.0, 1.0);
    if (specular_factor > 0.0f && specular_factor < 1.0f)
        monitor.note(
            document.where() + ": " + place +
            ": specularFactor counts along the normal; grazing light is reflected as if it "
            "were 1");

    m.emission = factors.vector<3>(json, "emissiveFactor", 0.0, unbounded);
    if (max_channel(m.emission) > 1.0f)
        monitor.note(document.where() + ": " + place +
                     ": emissiveFactor above the 1 of glTF is taken as it is");
    m.emission *= factors.scalar(object_or_empty(extensions, "KHR_materials_emissive_strength"),
                                 "emissiveStrength", 1.0, unbounded);
    if (!is_finite(m.emission))
        document.fail(place, "emission is not finite; accepted: finite numbers");

    m.opacity = 1.0f - factors.scalar(object_or_empty(extensions, "KHR_materials_transmission"),
                                      "transmissionFactor", 0.0, 1.0);
    const std::string mode = json.value("alphaMode", "OPAQUE");
    if (mode == "BLEND")
        m.opacity *= base.a;
    else if (mode == "MASK")
        m.opacity = base.a < factors.scalar(json, "alphaCutoff", 0.5, unbounded) ? 0.0f : m.opacity;
    else if (mode != "OPAQUE")
        document.fail(place, "alphaMode " + in_quotes(mode) + "; accepted: OPAQUE, MASK, BLEND");
    m.back_reflects = m.back_emits = json.value("doubleSided", false);
    return m;
}

}  // namespace

GltfReflection read_gltf_reflection(const GltfDocument& document, std::size_t index) {
    const Json& json = document.root().at("materials")[index];
    const Factors factors(document, place_of("materials", index));
    return {dielectric_reflectance(factors, object_or_empty(json, "extensions"))};
}

std::vector<Material> read_gltf_materials(const GltfDocument& document, Monitor& monitor) {
    std::vector<Material> materials;
    for (std::size_t i = 0; i < document.count("materials"); ++i)
        materials.push_back(read_material(document, i, monitor));
    return materials;
}

}  // namespace transillum
