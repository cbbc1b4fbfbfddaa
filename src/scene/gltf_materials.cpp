#include "scene/gltf_materials.h"

#include "scene/mean_colour.h"
#include "scene/soup.h"
#include "scene/text_reader.h"

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

/// What reflects: a dielectric of that reflectance over the base colour, or a metal of it.
struct Reflection {
    Spectrum base;
    float metallic;
    Spectrum dielectric;

    void fill(Material& m) const {
        m.diffuse = base * (1.0f - metallic);
        m.specular = glm::mix(dielectric, base, metallic);
        m.lobe = max_channel(m.specular) > 0.0f ? Lobe::ggx : Lobe::none;
    }
};

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

Reflection read_reflection(const Factors& factors, const Json& json) {
    const Json& pbr = object_or_empty(json, "pbrMetallicRoughness");
    return {Spectrum(factors.vector<4>(pbr, "baseColorFactor", 1.0, 1.0)),
            factors.scalar(pbr, "metallicFactor", 1.0, 1.0),
            dielectric_reflectance(factors, object_or_empty(json, "extensions"))};
}

Material read_material(const GltfDocument& document, std::size_t index, Monitor& monitor) {
    const Json& json = document.root().at("materials")[index];
    Material m = named_material(json.value("name", "material " + std::to_string(index)));
    const std::string place = place_of_material(index, m.name);
    const Factors factors(document, place);
    const Json& extensions = object_or_empty(json, "extensions");
    const Json& pbr = object_or_empty(json, "pbrMetallicRoughness");

    const float alpha = factors.vector<4>(pbr, "baseColorFactor", 1.0, 1.0).a;
    read_reflection(factors, json).fill(m);
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
        m.opacity *= alpha;
    else if (mode == "MASK")
        m.opacity = alpha < factors.scalar(json, "alphaCutoff", 0.5, unbounded) ? 0.0f : m.opacity;
    else if (mode != "OPAQUE")
        document.fail(place, "alphaMode " + in_quotes(mode) + "; accepted: OPAQUE, MASK, BLEND");
    m.back_reflects = m.back_emits = json.value("doubleSided", false);
    return m;
}

glm::dvec4 mean_of_texture(const GltfDocument& document, const std::string& place,
                           const Json& use) {
    const Json& texture = document.element("textures", use.at("index"));
    if (!texture.contains("source"))
        document.fail(place, "its base colour texture has no image; accepted: one with a source");
    const Json& image = document.element("images", texture.at("source"));
    const std::string where = document.where() + ": " + place;
    if (image.contains("bufferView"))
        return mean_colour(where + ": image", document.buffer_view(image.at("bufferView")));
    const auto uri = image.at("uri").get<std::string>();
    if (uri.starts_with("data:"))
        return mean_colour(where + ": image", decode_data_uri(where, uri));
    const std::filesystem::path file = document.file_of(uri);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored))
        document.fail(place, "its texture " + in_quotes(file.string()) +
                                 " is not there; accepted: an image file");
    return mean_colour(file.string());
}

}  // namespace

std::vector<Material> read_gltf_materials(const GltfDocument& document, Monitor& monitor) {
    std::vector<Material> materials;
    for (std::size_t i = 0; i < document.count("materials"); ++i)
        materials.push_back(read_material(document, i, monitor));
    return materials;
}

void bake_gltf_textures(const GltfDocument& document, std::size_t index, Material& material,
                        Monitor& monitor) {
    const Json& json = document.root().at("materials")[index];
    const Json& pbr = object_or_empty(json, "pbrMetallicRoughness");
    const std::string place = place_of_material(index, material.name);
    const std::string where = document.where() + ": " + place;
    if (json.contains("emissiveTexture")) monitor.warn(where + ": emissiveTexture is not honoured");
    if (pbr.contains("metallicRoughnessTexture"))
        monitor.warn(where + ": metallicRoughnessTexture is not honoured");
    if (!pbr.contains("baseColorTexture")) return;

    const glm::dvec4 mean = mean_of_texture(document, place, pbr.at("baseColorTexture"));
    Reflection reflection = read_reflection(Factors(document, place), json);
    reflection.base *= Spectrum(mean);
    reflection.fill(material);
    if (json.value("alphaMode", "OPAQUE") == "BLEND")
        material.opacity *= static_cast<float>(mean.a);
    monitor.note(where + ": its base colour texture is baked with its mean colour");
}

}  // namespace transillum
