#include "scene/read_mtl.h"

#include "scene/soup.h"
#include "scene/text_reader.h"

#include <transillum/scene/brdf.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace transillum {

namespace {

constexpr double unbounded = std::numeric_limits<float>::max();

/// What the statements after a `newmtl` said.
struct Statements {
    std::string name;
    MtlMap diffuse_map, specular_map, emission_map;
    std::optional<Spectrum> kd, ks, ke;
    std::optional<double> ns, opacity, transparency, illum;
};

class MtlReader {
public:
    MtlReader(const std::filesystem::path& path, std::string_view text, Monitor& monitor)
        : reader_(path.string(), text, {.continuation = true}),
          path_(path.string()),
          monitor_(monitor) {}

    std::vector<MtlMaterial> read() {
        while (reader_.next_line()) read_statement();
        finish_material();
        return std::move(materials_);
    }

private:
    void read_statement();
    void report_unused(std::string_view keyword, const Statements& m);
    void finish_material();
    [[nodiscard]] double value(std::size_t word, double most) const;
    [[nodiscard]] Spectrum colour(double most) const;
    [[nodiscard]] MtlMap map(const Statements& m) const;
    std::size_t read_option(std::size_t word, const Statements& m, MtlMap& map) const;
    void take_factors_of_maps(Statements& m);

    TextReader reader_;
    std::string path_;
    Monitor& monitor_;
    std::optional<Statements> current_;
    std::vector<MtlMaterial> materials_;
};

double MtlReader::value(std::size_t word, double most) const {
    if (word >= reader_.words().size())
        reader_.fail(in_quotes(reader_.rest(0)) + " has no value; accepted: a number");
    const double v = reader_.number(reader_.words()[word]);
    if (v < 0.0 || v > most)
        reader_.fail(std::string(reader_.words()[0]) + " is " + std::string(reader_.words()[word]) +
                     "; accepted: 0 " + (most == unbounded ? "or more" : "to " + shown(most)));
    return v;
}

Spectrum MtlReader::colour(double most) const {
    const std::size_t count = reader_.words().size() - 1;
    if (count == 1) return Spectrum(static_cast<float>(value(1, most)));
    if (count != 3)
        reader_.fail(in_quotes(reader_.rest(0)) + " found; accepted: one or three numbers");
    Spectrum s;
    for (int i = 0; i < 3; ++i)
        s[i] = static_cast<float>(value(static_cast<std::size_t>(i) + 1, most));
    return s;
}

/// Takes the option of a map that begins at a word; returns the word after it. Numbers end where
/// the file name must begin.
std::size_t MtlReader::read_option(std::size_t word, const Statements& m, MtlMap& map) const {
    const auto& words = reader_.words();
    const std::string_view option = words[word++];
    std::vector<double> numbers;
    while (word + 1 < words.size() &&
           words[word].find_first_not_of("0123456789+-.eE") == std::string_view::npos)
        numbers.push_back(reader_.number(words[word++]));
    std::string_view name;
    constexpr std::array<std::string_view, 8> named{"on", "off", "r", "g", "b", "m", "l", "z"};
    if (word + 1 < words.size() && std::ranges::count(named, words[word]) > 0) name = words[word++];

    const auto vector = [&](double second) {
        return glm::vec2(numbers[0], numbers.size() > 1 ? numbers[1] : second);
    };
    constexpr std::array<std::string_view, 4> harmless{"-blendu", "-blendv", "-texres", "-type"};
    if (option == "-s" && !numbers.empty())
        map.scale = vector(1.0);
    else if (option == "-o" && !numbers.empty())
        map.offset = vector(0.0);
    else if (option == "-clamp")
        map.clamp = name == "on";
    else if (std::ranges::count(harmless, option) == 0)
        monitor_.warn(path_ + ":" + std::to_string(reader_.line()) + ": material " +
                      in_quotes(m.name) + ": option " + in_quotes(option) + " is not honoured");
    return word;
}

/// Options (`-s 1 1 1`, `-clamp on`), then the file name.
MtlMap MtlReader::map(const Statements& m) const {
    const auto& words = reader_.words();
    MtlMap map;
    std::size_t i = 1;
    while (i < words.size() && words[i][0] == '-') i = read_option(i, m, map);
    map.file = reader_.rest(i);
    if (map.file.empty())
        reader_.fail(in_quotes(reader_.rest(0)) + " names no file; accepted: a file name");
    std::ranges::replace(map.file, '\\', '/');
    return map;
}

void MtlReader::read_statement() {
    const std::string_view keyword = reader_.words()[0];
    if (keyword == "newmtl") {
        finish_material();
        current_.emplace().name = reader_.rest(1);
        return;
    }
    if (!current_)
        reader_.fail(in_quotes(keyword) + " found before any material; accepted: newmtl");
    Statements& m = *current_;
    if (keyword == "Kd")
        m.kd = colour(1.0);
    else if (keyword == "Ks")
        m.ks = colour(1.0);
    else if (keyword == "Ke")
        m.ke = colour(unbounded);
    else if (keyword == "Ns")
        m.ns = value(1, unbounded);
    else if (keyword == "d")
        m.opacity = value(reader_.words().size() > 1 && reader_.words()[1] == "-halo" ? 2 : 1, 1.0);
    else if (keyword == "Tr")
        m.transparency = value(1, 1.0);
    else if (keyword == "illum")
        m.illum = value(1, 10.0);
    else if (keyword == "map_Kd")
        m.diffuse_map = map(m);
    else if (keyword == "map_Ks")
        m.specular_map = map(m);
    else if (keyword == "map_Ke")
        m.emission_map = map(m);
    else
        report_unused(keyword, m);
}

void MtlReader::report_unused(std::string_view keyword, const Statements& m) {
    // They say nothing about reflection or emission, or only where light is transmitted.
    constexpr std::array<std::string_view, 6> harmless{"Ka",        "Ni",      "map_Ka",
                                                       "sharpness", "map_aat", "refl"};
    if (std::ranges::count(harmless, keyword) > 0) return;
    if (keyword == "Tf" && colour(unbounded) == Spectrum(1.0f)) return;
    const std::string message = path_ + ":" + std::to_string(reader_.line()) + ": material " +
                                in_quotes(m.name) + ": " + in_quotes(keyword) + " is not honoured";
    if (keyword.starts_with("map_")) {
        monitor_.warn(message);
    } else {
        monitor_.note(message);
    }
}

/// A map without a factor stands alone.
void MtlReader::take_factors_of_maps(Statements& m) {
    m.diffuse_map.without = m.kd.value_or(Spectrum(0.5f));
    m.specular_map.without = m.ks.value_or(Spectrum(0.0f));
    m.emission_map.without = m.ke.value_or(Spectrum(0.0f));
    if (!m.diffuse_map.file.empty() && !m.kd) m.kd = Spectrum(1.0f);
    if (!m.specular_map.file.empty() && !m.ks) m.ks = Spectrum(1.0f);
    if (!m.emission_map.file.empty() && !m.ke) m.ke = Spectrum(1.0f);
}

void MtlReader::finish_material() {
    if (!current_) return;
    take_factors_of_maps(*current_);
    const Statements& m = *current_;
    MtlMaterial result{named_material(m.name), m.diffuse_map, m.specular_map, m.emission_map};
    Material& material = result.material;
    if (m.kd) {
        material.diffuse = *m.kd;
    } else {
        monitor_.note(path_ + ": material " + in_quotes(m.name) + " has no Kd; 0.5 is taken");
    }
    const bool glossy = m.ks && max_channel(*m.ks) > 0.0f && m.illum.value_or(2.0) >= 2.0;
    if (glossy) {
        material.lobe = Lobe::max_phong;
        material.specular = *m.ks;
        material.shininess = static_cast<float>(m.ns.value_or(least_shininess));
        if (!m.ns || material.shininess < least_shininess)
            monitor_.note(path_ + ": material " + in_quotes(m.name) + " has Ks and " +
                          (m.ns ? "an Ns of " + shown(*m.ns) : "no Ns") + "; " +
                          shown(least_shininess) + " is taken");
    }
    material.emission = m.ke.value_or(Spectrum(0.0f));
    material.opacity = static_cast<float>(m.opacity.value_or(1.0 - m.transparency.value_or(0.0)));
    materials_.push_back(std::move(result));
    current_.reset();
}

}  // namespace

std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path, Monitor& monitor) {
    const std::string text = read_file(path);
    return MtlReader(path, text, monitor).read();
}

}  // namespace transillum
