#include "scene/write_gltf_materials.h"

#include "scene/gltf_reflection.h"
#include "scene/write_texture.h"

#include <transillum/scene/brdf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace transillum {

namespace {

using Json = GltfBuilder::Json;

constexpr float dielectric = 0.04f;

/// max-Phong is nearest to GGX where its peak falls off alike: alpha^2 = 2 / (n + 2).
float roughness_of_max_phong(float shininess) {
    return std::sqrt(std::sqrt(2.0f / (std::max(shininess, least_shininess) + 2.0f)));
}

struct BaseMetal {
    Spectrum base{0.0f};
    float metallic = 0.0f;
};

float error_of(const BaseMetal& b, const Spectrum& diffuse, const Spectrum& specular) {
    const GltfReflection reflection{Spectrum(dielectric)};
    return max_channel(glm::max(glm::abs(GltfReflection::diffuse(b.base, b.metallic) - diffuse),
                                glm::abs(reflection.specular(b.base, b.metallic) - specular)));
}

/// With u = 1 - metallic: diffuse = base u, specular = F0 u + base (1 - u); so base = diffuse +
/// specular - F0 u, and of the channels' sums F u^2 - (S + D) u + D = 0. Bases darker than F0 may
/// have two roots, of which the channels tell the one.
BaseMetal solve(const Spectrum& diffuse, const Spectrum& specular) {
    const auto sum = [](const Spectrum& s) {
        return static_cast<double>(s.r) + static_cast<double>(s.g) + static_cast<double>(s.b);
    };
    const double d = sum(diffuse), s = sum(specular), f = 3.0 * static_cast<double>(dielectric);
    const double root = std::sqrt(std::max(0.0, (s + d) * (s + d) - 4.0 * f * d));
    const auto with = [&](double u) {
        u = std::clamp(u, 0.0, 1.0);
        const Spectrum base =
            diffuse + specular - static_cast<float>(u * static_cast<double>(dielectric));
        return BaseMetal{glm::clamp(base, 0.0f, 1.0f), static_cast<float>(1.0 - u)};
    };
    const BaseMetal first = with(s + d > 0.0 ? 2.0 * d / (s + d + root) : 0.0);
    const BaseMetal second = with((s + d + root) / (2.0 * f));
    return error_of(second, diffuse, specular) < error_of(first, diffuse, specular) ? second
                                                                                    : first;
}

Json channels(const Spectrum& s) {
    return {s.r, s.g, s.b};
}

int wrap_number(Texture::Wrap wrap) {
    return wrap == Texture::Wrap::repeat ? 10497 : wrap == Texture::Wrap::clamp ? 33071 : 33648;
}

/// A texel of the grid of another texture.
Spectrum texel_at(const Texture& texture, int x, int y, const Texture& grid) {
    if (texture.width == grid.width && texture.height == grid.height)
        return texture.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) +
                              static_cast<std::size_t>(x)];
    return texture.at({(static_cast<float>(x) + 0.5f) / static_cast<float>(grid.width),
                       (static_cast<float>(y) + 0.5f) / static_cast<float>(grid.height)});
}

class MaterialWriter {
public:
    explicit MaterialWriter(GltfBuilder& builder)
        : builder_(builder), writer_(builder.writer()), scene_(writer_.scene) {}

    void write(const Material& m, bool is_used);
    void finish() const;

private:
    struct Image {
        std::size_t texture = 0;
        Spectrum factor{1.0f};
    };

    void write_reflection(const Material& m, const MaterialTextures& textures, Json& json);
    void write_uniform(const Material& m, Json& json, Json& pbr);
    void write_specular(const Spectrum& reflectance, Json& json);
    void write_textured(const Material& m, const MaterialTextures& textures, Json& json, Json& pbr);
    void write_base(const Image& image, Json& pbr);
    void write_roughness(const Texture& roughness_metal, Json& pbr);
    void write_emission(const Material& m, std::int32_t texture, Json& json);
    void write_sides(const Material& m, Json& json);

    const Texture& texture(std::int32_t number) const {
        return *scene_.textures[static_cast<std::size_t>(number)];
    }
    /// Of textures that are made for a material, by the textures they are made from.
    Image image_of(const std::string& key, const Texture& texture, ImageUse use);

    GltfBuilder& builder_;
    const SceneWriter& writer_;
    const Scene& scene_;
    std::map<std::string, Image> images_;
    std::map<std::string, std::size_t> samplers_;
    std::size_t max_phong_ = 0, unsolved_ = 0, back_black_ = 0;
    float largest_error_ = 0.0f, largest_unsolved_ = 0.0f;
};

MaterialWriter::Image MaterialWriter::image_of(const std::string& key, const Texture& texture,
                                               ImageUse use) {
    if (const auto found = images_.find(key); found != images_.end()) return found->second;
    const EncodedImage encoded = encode_texture(texture, use);
    largest_error_ = std::max(largest_error_, encoded.largest_error);
    const Json sampler{{"wrapS", wrap_number(texture.wrap_u)},
                       {"wrapT", wrap_number(texture.wrap_v)}};
    const auto [at, is_new] = samplers_.try_emplace(sampler.dump());
    if (is_new) at->second = builder_.add("samplers", sampler);
    const std::size_t source = builder_.add_image(encoded.png);
    const Image image{builder_.add("textures", {{"sampler", at->second}, {"source", source}}),
                      encoded.factor};
    images_.emplace(key, image);
    return image;
}

/// `specular` of a dielectric that is no metal at all.
void MaterialWriter::write_specular(const Spectrum& reflectance, Json& json) {
    if (reflectance == Spectrum(dielectric)) return;
    builder_.use_extension("KHR_materials_specular");
    Json& extension = json["extensions"]["KHR_materials_specular"];
    if (max_channel(reflectance) > 0.0f) {
        extension["specularColorFactor"] = channels(reflectance / dielectric);
    } else {
        extension["specularFactor"] = 0;
    }
}

void MaterialWriter::write_uniform(const Material& m, Json& json, Json& pbr) {
    BaseMetal b{m.diffuse, 0.0f};
    if (m.lobe == Lobe::none) {
        write_specular(Spectrum(0.0f), json);
    } else if (max_channel(m.diffuse) == 0.0f) {
        b = {m.specular, 1.0f};
    } else if (const BaseMetal solved = solve(m.diffuse, m.specular);
               error_of(solved, m.diffuse, m.specular) < 1e-7f) {
        b = solved;
    } else {
        write_specular(m.specular, json);
    }
    pbr["baseColorFactor"] = {b.base.r, b.base.g, b.base.b, m.opacity};
    pbr["metallicFactor"] = b.metallic;
}

void MaterialWriter::write_base(const Image& image, Json& pbr) {
    for (std::size_t c = 0; c < 3; ++c)
        pbr["baseColorFactor"][c] = image.factor[static_cast<int>(c)];
    pbr["baseColorTexture"]["index"] = image.texture;
}

/// Green and blue hold roughness and metalness. \pre the factors are set
void MaterialWriter::write_roughness(const Texture& roughness_metal, Json& pbr) {
    std::ostringstream key;
    key << "rough " << roughness_metal.name;
    pbr["metallicRoughnessTexture"]["index"] =
        image_of(key.str(), roughness_metal, ImageUse::numbers).texture;
}

void MaterialWriter::write_textured(const Material& m, const MaterialTextures& textures, Json& json,
                                    Json& pbr) {
    pbr["baseColorFactor"] = {m.diffuse.r, m.diffuse.g, m.diffuse.b, m.opacity};
    pbr["metallicFactor"] = 0;
    if (textures.specular < 0) {
        write_specular(m.lobe == Lobe::none ? Spectrum(0.0f) : m.specular, json);
        if (textures.diffuse < 0) return;
        const std::string key = "base " + std::to_string(textures.diffuse);
        return write_base(image_of(key, texture(textures.diffuse), ImageUse::albedo), pbr);
    }
    const Texture& specular = texture(textures.specular);
    const Texture* diffuse = textures.diffuse < 0 ? nullptr : &texture(textures.diffuse);
    const Texture* rough = textures.roughness < 0 ? nullptr : &texture(textures.roughness);
    Texture base{specular}, metal{specular};
    base.levels.clear();
    metal.levels.clear();
    float unsolved = 0.0f;
    for (int y = 0; y < base.height; ++y)
        for (int x = 0; x < base.width; ++x) {
            const auto t = static_cast<std::size_t>(y) * static_cast<std::size_t>(base.width) +
                           static_cast<std::size_t>(x);
            const Spectrum d = diffuse ? texel_at(*diffuse, x, y, base) : m.diffuse;
            const BaseMetal b = solve(d, specular.texels[t]);
            unsolved = std::max(unsolved, error_of(b, d, specular.texels[t]));
            base.texels[t] = b.base;
            metal.texels[t] = {1.0f, rough ? texel_at(*rough, x, y, base).g : 1.0f, b.metallic};
        }
    if (unsolved > 1e-4f) ++unsolved_;
    largest_unsolved_ = std::max(largest_unsolved_, unsolved);
    std::ostringstream key;
    key << textures.diffuse << ' ' << textures.specular;
    if (!diffuse) key << ' ' << m.diffuse.r << ' ' << m.diffuse.g << ' ' << m.diffuse.b;
    write_base(image_of("solved base " + key.str(), base, ImageUse::albedo), pbr);
    key << ' ' << textures.roughness;
    metal.name = key.str();
    pbr["metallicFactor"] = 1;
    write_roughness(metal, pbr);
}

void MaterialWriter::write_reflection(const Material& m, const MaterialTextures& textures,
                                      Json& json) {
    Json& pbr = json["pbrMetallicRoughness"];
    const bool is_phong = m.lobe == Lobe::max_phong;
    max_phong_ += is_phong;
    pbr["roughnessFactor"] = is_phong ? roughness_of_max_phong(m.shininess) : m.roughness;
    if (textures.diffuse < 0 && textures.specular < 0) {
        write_uniform(m, json, pbr);
    } else {
        write_textured(m, textures, json, pbr);
    }
    if (textures.roughness < 0) return;
    pbr["roughnessFactor"] = 1;
    if (textures.specular >= 0) return;
    Texture rough = texture(textures.roughness);
    rough.levels.clear();
    rough.name = std::to_string(textures.roughness);
    for (Spectrum& texel : rough.texels) texel = {1.0f, texel.g, 1.0f};
    write_roughness(rough, pbr);
}

void MaterialWriter::write_emission(const Material& m, std::int32_t number, Json& json) {
    if (!m.emits()) return;
    Spectrum factor = m.emission;
    if (number >= 0) {
        const Image image =
            image_of("emission " + std::to_string(number), texture(number), ImageUse::emission);
        json["emissiveTexture"]["index"] = image.texture;
        factor = image.factor;
    }
    // A power of two leaves all digits as they are.
    int exponent = 0;
    if (max_channel(factor) > 1.0f) std::frexp(max_channel(factor), &exponent);
    const float whole = std::ldexp(1.0f, std::min(exponent, 127));
    json["emissiveFactor"] = channels(factor / whole);
    if (whole == 1.0f) return;
    builder_.use_extension("KHR_materials_emissive_strength");
    json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = whole;
}

void MaterialWriter::write_sides(const Material& m, Json& json) {
    const bool both = m.back_reflects && (m.back_emits || !m.emits());
    if (both) json["doubleSided"] = true;
    back_black_ += !both && (m.back_reflects || (m.back_emits && m.emits()));
}

void MaterialWriter::write(const Material& m, bool is_used) {
    Json json;
    json["name"] = m.name;
    const MaterialTextures textures = is_used ? m.textures : MaterialTextures{};
    write_reflection(m, textures, json);
    write_emission(m, textures.emission, json);
    write_sides(m, json);
    if (m.opacity < 1.0f) json["alphaMode"] = "BLEND";
    builder_.add("materials", std::move(json));
}

void MaterialWriter::finish() const {
    writer_.warn_materials(max_phong_, "with a max-Phong lobe; glTF holds the nearest GGX lobe");
    writer_.warn_materials(back_black_,
                           "whose back reflects or emits alone; in glTF the back is black");
    const auto told = [&](const char* what, float by) {
        std::ostringstream text;
        text << what << by;
        return text.str();
    };
    writer_.warn_materials(
        unsolved_, told("whose textures glTF cannot hold; off by up to ", largest_unsolved_));
    if (largest_error_ > 0.0f)
        writer_.monitor.note(
            writer_.files.main().string() +
            told(": images hold 16 bits a channel; texels were moved by up to ", largest_error_));
}

}  // namespace

void write_gltf_materials(GltfBuilder& builder) {
    const Scene& scene = builder.writer().scene;
    MaterialWriter writer(builder);
    const std::vector<bool> used = builder.writer().used_materials();
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        writer.write(scene.materials[i], used[i]);
    writer.finish();
}

}  // namespace transillum
