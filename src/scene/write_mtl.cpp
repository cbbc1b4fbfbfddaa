#include "scene/write_mtl.h"

#include "scene/text_writer.h"
#include "scene/write_texture.h"

#include <transillum/scene/brdf.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <sstream>

namespace transillum {

namespace {

/// GGX is nearest to cos^n where its peak falls off alike: alpha^2 = 2 / (n + 2).
float shininess_of_ggx(float roughness) {
    const float alpha = std::max(roughness * roughness, least_alpha);
    return std::max(2.0f / (alpha * alpha) - 2.0f, least_shininess);
}

struct Image {
    std::string file;
    Spectrum factor{1.0f};
};

class MtlWriter {
public:
    MtlWriter(const SceneWriter& writer) : writer_(writer), stem_(writer.stem()) {}

    void write(const Material& m, const std::string& name, bool is_used) {
        text_.word("newmtl").word(name).end_line();
        const MaterialTextures textures = is_used ? m.textures : MaterialTextures{};
        property("Kd", "map_Kd", m.diffuse, textures.diffuse);
        if (m.lobe != Lobe::none) {
            property("Ks", "map_Ks", m.specular, textures.specular);
            const bool is_ggx = m.lobe == Lobe::ggx;
            text_.word("Ns").number(is_ggx ? shininess_of_ggx(m.roughness) : m.shininess);
            text_.end_line();
            ggx_ += is_ggx;
            rough_ += textures.roughness >= 0;
        }
        if (m.emits()) property("Ke", "map_Ke", m.emission, textures.emission);
        if (m.opacity < 1.0f) text_.word("d").number(m.opacity).end_line();
        text_.word("illum").integer(m.lobe == Lobe::none ? 1 : 2).end_line();
        back_black_ += !m.back_reflects;
        back_emits_ += m.back_reflects && m.back_emits && m.emits();
    }

    void finish(const std::string& file) {
        writer_.warn_materials(ggx_, "with a GGX lobe; MTL holds the nearest max-Phong lobe");
        writer_.warn_materials(rough_, "with textured roughness; MTL holds their mean");
        writer_.warn_materials(back_black_, "with a black back; MTL holds no sides: --sides");
        writer_.warn_materials(back_emits_, "whose back emits; MTL holds no sides: --sides");
        if (mirrored_ > 0) writer_.leave_out("mirrored or mixed wrapping of textures", mirrored_);
        if (largest_error_ > 0.0f) {
            std::ostringstream text;
            text << writer_.files.main().string()
                 << ": images hold 16 bits a channel; texels were moved by up to "
                 << largest_error_;
            writer_.monitor.note(text.str());
        }
        writer_.files.write(file, text_.text());
    }

private:
    void property(const char* factor, const char* map, const Spectrum& value, std::int32_t number) {
        const auto line = [&](const Spectrum& s) {
            text_.word(factor).number(s.r).number(s.g).number(s.b).end_line();
        };
        if (number < 0) return line(value);
        const Image& image = image_of(number);
        line(image.factor);
        text_.word(map);
        if (writer_.scene.textures[static_cast<std::size_t>(number)]->wrap_u ==
            Texture::Wrap::clamp)
            text_.word("-clamp").word("on");
        text_.word(image.file).end_line();
    }

    const Image& image_of(std::int32_t number) {
        const auto [found, is_new] = images_.try_emplace(number);
        if (!is_new) return found->second;
        const Texture& texture = *writer_.scene.textures[static_cast<std::size_t>(number)];
        const EncodedImage encoded = encode_texture(texture, ImageUse::emission);
        found->second = {stem_ + "-texture-" + std::to_string(images_.size()) + ".png",
                         encoded.factor};
        writer_.files.write(found->second.file, encoded.png);
        largest_error_ = std::max(largest_error_, encoded.largest_error);
        mirrored_ += texture.wrap_u != texture.wrap_v || texture.wrap_u == Texture::Wrap::mirrored;
        return found->second;
    }

    const SceneWriter& writer_;
    std::string stem_;
    TextWriter text_;
    std::map<std::int32_t, Image> images_;  ///< by texture
    std::size_t ggx_ = 0, rough_ = 0, back_black_ = 0, back_emits_ = 0, mirrored_ = 0;
    float largest_error_ = 0.0f;
};

}  // namespace

std::string name_in_text(std::string_view name) {
    std::string text(name);
    for (char& c : text)
        if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
    text.erase(0, text.find_first_not_of(' '));
    text.erase(text.find_last_not_of(' ') + 1);
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '#' && (i == 0 || text[i - 1] == ' ')) text[i] = '_';
    if (text.ends_with('\\')) text.back() = '_';
    return text;
}

std::vector<std::string> material_names(const SceneWriter& writer) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    std::size_t changed = 0;
    for (const Material& m : writer.scene.materials) taken.insert(name_in_text(m.name));
    std::set<std::string> given;
    for (const Material& m : writer.scene.materials) {
        std::string name = name_in_text(m.name);
        for (int i = 2; name.empty() || given.contains(name); ++i) {
            const std::string next = name_in_text(m.name) + "-" + std::to_string(i);
            name = taken.contains(next) ? std::string() : next;
        }
        changed += name != m.name;
        given.insert(name);
        names.push_back(std::move(name));
    }
    if (changed > 0)
        writer.monitor.note(writer.files.main().string() + ": " + std::to_string(changed) +
                            " materials are renamed, as " + writer.format +
                            " tells them apart by name");
    return names;
}

void write_mtl(const SceneWriter& writer, const std::string& file,
               const std::vector<std::string>& names) {
    MtlWriter mtl(writer);
    const std::vector<bool> used = writer.used_materials();
    for (std::size_t i = 0; i < names.size(); ++i)
        mtl.write(writer.scene.materials[i], names[i], used[i]);
    mtl.finish(file);
}

}  // namespace transillum
