#include "scene/gltf_textures.h"

#include "scene/read_texture.h"
#include "scene/scene_textures.h"
#include "scene/text_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace transillum {

namespace {

using Image = std::optional<TextureImage>;

const Json& member_or_null(const Json& object, const char* key) {
    static const Json null;
    const auto found = object.find(key);
    return found == object.end() ? null : *found;
}

template <std::size_t N>
std::array<float, N> numbers(const Json& object, const char* key,
                             const std::array<float, N>& fallback) {
    return object.contains(key) ? object.at(key).get<std::array<float, N>>() : fallback;
}

TextureFrame frame_of_use(const GltfDocument& document, const Json& use) {
    TextureFrame frame;
    frame.set = size_value(document, use, "texCoord", 0);
    const Json& transform =
        member_or_null(member_or_null(use, "extensions"), "KHR_texture_transform");
    if (transform.is_null()) return frame;
    frame.set = size_value(document, transform, "texCoord", frame.set);
    const auto offset = numbers<2>(transform, "offset", {0.0f, 0.0f});
    const auto scale = numbers<2>(transform, "scale", {1.0f, 1.0f});
    const float angle = transform.value("rotation", 0.0f);
    const float c = std::cos(angle), s = std::sin(angle);
    frame.offset = {offset[0], offset[1]};
    // Counter-clockwise as seen, with v running downwards.
    frame.turn = glm::mat2(c, -s, s, c) * glm::mat2(scale[0], 0.0f, 0.0f, scale[1]);
    return frame;
}

Texture::Wrap wrap_mode(const GltfDocument& document, const Json& sampler, const char* key) {
    switch (size_value(document, sampler, key, 10497)) {
        case 10497:
            return Texture::Wrap::repeat;
        case 33071:
            return Texture::Wrap::clamp;
        case 33648:
            return Texture::Wrap::mirrored;
        default:
            document.fail("samplers", std::string(key) + " is " + sampler.at(key).dump() +
                                          "; accepted: 10497, 33071, 33648");
    }
}

/// Reads what a material's texture entries name.
class ImageReader {
public:
    ImageReader(const GltfDocument& document, std::string where, TextureFrame frame,
                Monitor& monitor)
        : document_(document), where_(std::move(where)), frame_(frame), monitor_(monitor) {}

    /// Empty where there is no such entry or, with a warning, no such image.
    Image read(const Json& parent, const char* key, ImageUse image_use) const {
        const Json& use = member_or_null(parent, key);
        if (use.is_null()) return std::nullopt;
        const Json& texture = document_.element("textures", use.at("index"));
        Image image = open(texture, key, image_use);
        if (!image) return image;
        if (texture.contains("sampler")) {
            const Json& sampler = document_.element("samplers", texture.at("sampler"));
            image->texture.wrap_u = wrap_mode(document_, sampler, "wrapS");
            image->texture.wrap_v = wrap_mode(document_, sampler, "wrapT");
        }
        if (frame_of_use(document_, use) != frame_) take_mean(*image, key);
        return image;
    }

private:
    Image open(const Json& texture, const char* key, ImageUse use) const {
        if (!texture.contains("source")) return warn_missing(key, "of a format of glTF 2.0");
        const Json& image = document_.element("images", texture.at("source"));
        if (image.contains("bufferView"))
            return read_texture(where_ + ": " + key, use, monitor_,
                                document_.buffer_view(image.at("bufferView")));
        const auto uri = image.at("uri").get<std::string>();
        if (uri.starts_with("data:"))
            return read_texture(where_ + ": " + key, use, monitor_, decode_data_uri(where_, uri));
        const std::filesystem::path file = document_.file_of(uri);
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(file, ignored))
            return warn_missing(key, in_quotes(uri));
        return read_texture(file.string(), use, monitor_);
    }

    Image warn_missing(const char* key, const std::string& what) const {
        monitor_.warn(where_ + ": the image of its " + key + ", " + what +
                      ", is not there; the factor alone is taken");
        return std::nullopt;
    }

    void take_mean(TextureImage& image, const char* key) const {
        monitor_.warn(where_ + ": its " + key +
                      " has texture coordinates of its own; its mean is taken");
        image.texture.texels = {image.texture.mean()};
        image.texture.width = image.texture.height = 1;
        image.alpha.clear();
    }

    const GltfDocument& document_;
    std::string where_;
    TextureFrame frame_;
    Monitor& monitor_;
};

/// The texels of an image on a grid that may be finer than its own.
class Resampled {
public:
    Resampled(const Image& image, int width, int height)
        : texture_(image ? &image->texture : nullptr), width_(width), height_(height) {}
    [[nodiscard]] Spectrum operator()(int x, int y) const {
        if (!texture_) return Spectrum(1.0f);
        if (texture_->width == width_ && texture_->height == height_)
            return texture_->texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                    static_cast<std::size_t>(x)];
        return texture_->at({(static_cast<float>(x) + 0.5f) / static_cast<float>(width_),
                             (static_cast<float>(y) + 0.5f) / static_cast<float>(height_)});
    }

private:
    const Texture* texture_;
    int width_, height_;
};

/// A texture of the size of the larger image; `value_of` maps texels of both.
template <class ValueOf>
Texture combine(const Image& first, const Image& second, ValueOf value_of) {
    const Texture& named = first ? first->texture : second->texture;
    Texture result{.name = named.name, .wrap_u = named.wrap_u, .wrap_v = named.wrap_v};
    for (const Image* image : {&first, &second}) {
        if (!*image) continue;
        result.width = std::max(result.width, (*image)->texture.width);
        result.height = std::max(result.height, (*image)->texture.height);
    }
    const Resampled a(first, result.width, result.height), b(second, result.width, result.height);
    result.texels.reserve(static_cast<std::size_t>(result.width) *
                          static_cast<std::size_t>(result.height));
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) result.texels.push_back(value_of(a(x, y), b(x, y)));
    return result;
}

void set(Scene& scene, Texture texture, Spectrum& mean, std::int32_t& index) {
    const Textured made = add_texture(scene, std::move(texture));
    mean = made.mean;
    index = made.texture;
}

void set_reflection(const Json& pbr, const Image& base_image, const Image& rough_metal,
                    const GltfReflection& reflection, Scene& scene, Material& m) {
    if (!base_image && !rough_metal) return;
    const auto factor = numbers<4>(pbr, "baseColorFactor", {1.0f, 1.0f, 1.0f, 1.0f});
    const float metallic_factor = pbr.value("metallicFactor", 1.0f);
    const float roughness_factor = pbr.value("roughnessFactor", 1.0f);
    const auto base = [&](const Spectrum& t) {
        return t * Spectrum(factor[0], factor[1], factor[2]);
    };
    const auto metallic = [&](const Spectrum& t) { return metallic_factor * t.b; };
    set(scene,
        combine(base_image, rough_metal,
                [&](const Spectrum& b, const Spectrum& rm) {
                    return GltfReflection::diffuse(base(b), metallic(rm));
                }),
        m.diffuse, m.textures.diffuse);
    set(scene,
        combine(base_image, rough_metal,
                [&](const Spectrum& b, const Spectrum& rm) {
                    return reflection.specular(base(b), metallic(rm));
                }),
        m.specular, m.textures.specular);
    if (!rough_metal) return;
    Spectrum roughness;
    set(scene,
        combine(
            rough_metal, std::nullopt,
            [&](const Spectrum& rm, const Spectrum&) { return Spectrum(roughness_factor * rm.g); }),
        roughness, m.textures.roughness);
    m.roughness = roughness.x;
}

void set_emission(const Image& image, Scene& scene, Material& m) {
    if (!image) return;
    const Spectrum factor = m.emission;
    set(scene,
        combine(image, std::nullopt,
                [&](const Spectrum& t, const Spectrum&) { return factor * t; }),
        m.emission, m.textures.emission);
}

void honour_alpha(const Json& json, const Image& base, const std::string& where, Material& m,
                  Monitor& monitor) {
    const std::string mode = json.value("alphaMode", "OPAQUE");
    if (!base || base->alpha.empty() || mode == "OPAQUE") return;
    const auto count = static_cast<double>(base->alpha.size());
    if (mode == "BLEND") {
        double sum = 0.0;
        for (const float a : base->alpha) sum += static_cast<double>(a);
        m.opacity *= static_cast<float>(sum / count);
        return;
    }
    const Json& pbr = member_or_null(json, "pbrMetallicRoughness");
    const float factor = numbers<4>(pbr, "baseColorFactor", {1.0f, 1.0f, 1.0f, 1.0f})[3];
    const float cutoff = json.value("alphaCutoff", 0.5f);
    const auto cut =
        std::ranges::count_if(base->alpha, [&](float a) { return factor * a < cutoff; });
    if (cut > 0)
        monitor.warn(where + ": its base colour texture cuts out " +
                     std::to_string(std::lround(100.0 * static_cast<double>(cut) / count)) +
                     " % of its texels, which are treated as opaque");
}

/// All that the textures of a material depend on.
std::string key_of(const Json& json, const Material& m, const GltfReflection& reflection) {
    Json key = Json::array();
    for (const char* name : {"pbrMetallicRoughness", "emissiveTexture", "alphaMode", "alphaCutoff"})
        key.push_back(member_or_null(json, name));
    for (int c = 0; c < channel_count; ++c) {
        key.push_back(m.emission[c]);
        key.push_back(reflection.dielectric[c]);
    }
    key.push_back(m.opacity);
    return key.dump();
}

}  // namespace

TextureFrame GltfTextures::frame_of(std::size_t material) const {
    const Json& json = document_.root().at("materials")[material];
    const Json& pbr = member_or_null(json, "pbrMetallicRoughness");
    for (const Json* use : {&member_or_null(pbr, "baseColorTexture"),
                            &member_or_null(pbr, "metallicRoughnessTexture"),
                            &member_or_null(json, "emissiveTexture")})
        if (!use->is_null()) return frame_of_use(document_, *use);
    return {};
}

void GltfTextures::apply(std::size_t index, const GltfReflection& reflection, Scene& scene) {
    const Json& json = document_.root().at("materials")[index];
    Material& m = scene.materials[index];
    const auto [same, is_new] = material_of_key_.try_emplace(key_of(json, m, reflection), index);
    if (!is_new) {
        const Material& like = scene.materials[same->second];
        m.diffuse = like.diffuse;
        m.specular = like.specular;
        m.roughness = like.roughness;
        m.emission = like.emission;
        m.opacity = like.opacity;
        m.textures = like.textures;
        return;
    }
    const Json& pbr = member_or_null(json, "pbrMetallicRoughness");
    const std::string where =
        document_.where() + ": " + place_of("materials", index) + " " + in_quotes(m.name);
    const ImageReader images(document_, where, frame_of(index), monitor_);
    const Image base = images.read(pbr, "baseColorTexture", ImageUse::albedo);
    honour_alpha(json, base, where, m, monitor_);
    set_reflection(pbr, base, images.read(pbr, "metallicRoughnessTexture", ImageUse::numbers),
                   reflection, scene, m);
    if (m.emits()) set_emission(images.read(json, "emissiveTexture", ImageUse::emission), scene, m);
}

}  // namespace transillum
