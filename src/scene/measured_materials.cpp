#include <transillum/scene/measured_materials.h>

#include "scene/soup.h"
#include "scene/text_reader.h"

#include <transillum/base/error.h>
#include <transillum/scene/limit_albedo.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>

namespace transillum {

namespace {

using Json = nlohmann::ordered_json;
using Table = std::optional<SpectrumTable>;

class Reader {
public:
    Reader(const std::filesystem::path& path, const std::vector<Material>& materials)
        : path_(path), materials_(materials) {}

    std::vector<MeasuredMaterial> read() const {
        const Json root = parse();
        std::vector<MeasuredMaterial> measured;
        for (const auto& [name, entry] : object("the file", root).items())
            measured.push_back(read_material(name, entry));
        return measured;
    }

private:
    [[noreturn]] void fail(const std::string& place, const std::string& what) const {
        throw InputError(path_.string(), place + ": " + what);
    }

    [[nodiscard]] Json parse() const try {
        return Json::parse(read_file(path_));
    } catch (const Json::parse_error& error) {
        throw InputError(path_.string(),
                         "no JSON, at byte " + std::to_string(error.byte) +
                             "; accepted: an object of materials, as {\"wall\": {\"reflectance\": "
                             "{\"file\": \"walls.csv\", \"column\": \"white\"}}}");
    }

    [[nodiscard]] const Json& object(const std::string& place, const Json& value) const {
        if (!value.is_object())
            fail(place, std::string(value.type_name()) + " found; accepted: an object");
        return value;
    }

    [[nodiscard]] std::string text(const std::string& place, const Json& entry,
                                   const char* key) const {
        if (!entry.contains(key)) fail(place, in_quotes(key) + " is missing; accepted: a string");
        if (!entry[key].is_string())
            fail(place,
                 in_quotes(key) + " is a " + entry[key].type_name() + "; accepted: a string");
        return entry[key].get<std::string>();
    }

    [[nodiscard]] MeasuredMaterial read_material(const std::string& name, const Json& entry) const {
        const std::string place = "material " + in_quotes(name);
        MeasuredMaterial result{name, {}, {}, {}, {}};
        check_name(place, name);
        for (const auto& [key, value] : object(place, entry).items()) {
            const std::string where = place + ", " + key;
            if (key == "reflectance")
                result.reflectance = read_reflectance(where, value);
            else if (key == "specular")
                result.specular = read_reflectance(where, value);
            else if (key == "emission")
                result.emission = read_emission(where, value, result.emission_scale);
            else
                fail(place, in_quotes(key) + " found; accepted: reflectance, specular, emission");
        }
        check_use(place, result);
        return result;
    }

    void check_name(const std::string& place, const std::string& name) const {
        std::string known;
        for (const Material& m : materials_) {
            if (m.name == name) return;
            known += (known.empty() ? "" : ", ") + in_quotes(m.name);
        }
        fail(place, "the scene has none of that name; accepted: " + known);
    }

    [[nodiscard]] SpectrumTable read_table(const std::string& place, const Json& entry,
                                           const std::vector<std::string>& keys) const {
        std::string accepted;
        for (const std::string& key : keys) accepted += (accepted.empty() ? "" : ", ") + key;
        for (const auto& item : object(place, entry).items())
            if (std::ranges::count(keys, item.key()) == 0)
                fail(place, in_quotes(item.key()) + " found; accepted: " + accepted);
        SpectrumTable table = read_spectrum(path_.parent_path() / text(place, entry, "file"),
                                            text(place, entry, "column"));
        const double first = table.wavelengths.front(), last = table.wavelengths.back();
        if (first > shortest_wavelength || last < longest_wavelength)
            fail(place, table.name + " spans " + shown(first) + " to " + shown(last) +
                            " nm; accepted: " + shown(shortest_wavelength) + " to " +
                            shown(longest_wavelength) + " nm or more");
        return table;
    }

    [[nodiscard]] SpectrumTable read_reflectance(const std::string& place,
                                                 const Json& entry) const {
        SpectrumTable table = read_table(place, entry, {"file", "column"});
        const auto most = std::ranges::max_element(table.values);
        if (*most > 1.0)
            fail(place,
                 table.name + " reflects " + shown(*most) + " at " +
                     shown(
                         table.wavelengths[static_cast<std::size_t>(most - table.values.begin())]) +
                     " nm; accepted: 0 to 1");
        return table;
    }

    [[nodiscard]] SpectrumTable read_emission(const std::string& place, const Json& entry,
                                              std::optional<double>& scale) const {
        SpectrumTable table = read_table(place, entry, {"file", "column", "scale"});
        if (!(table.integral(shortest_wavelength, longest_wavelength) > 0.0))
            fail(place, table.name + " is dark; accepted: some value above 0");
        if (entry.contains("scale")) {
            if (!entry["scale"].is_number() || !(entry["scale"].get<double>() > 0.0))
                fail(place, "scale " + entry["scale"].dump() + "; accepted: a number above 0");
            scale = entry["scale"].get<double>();
        }
        return table;
    }

    void check_use(const std::string& place, const MeasuredMaterial& measured) const {
        for (const Material& m : materials_) {
            if (m.name != measured.name) continue;
            if (measured.specular && m.lobe == Lobe::none)
                fail(place + ", specular",
                     "the material has no glossy lobe; accepted: reflectance, emission");
            if (measured.emission && !measured.emission_scale && !m.emits())
                fail(place + ", emission",
                     "the scene's material does not emit, so nothing says how brightly; accepted: "
                     "with a scale, radiance a unit of the spectrum");
        }
    }

    std::filesystem::path path_;
    const std::vector<Material>& materials_;
};

/// Leaves unmeasured materials alone. A limit for the sum of what is measured and what is not
/// knows textures by their means.
void limit(std::vector<Material>& materials, const SpectralOptions& options, Monitor& monitor) {
    Scene measured;
    std::vector<Material*> limited;
    for (Material& m : materials)
        for (const MeasuredMaterial& with : options.measured)
            if (m.name == with.name) {
                limited.push_back(&m);
                measured.materials.push_back(m);
                measured.materials.back().textures = {};
            }
    limit_albedo(measured, options.max_albedo, monitor);
    for (std::size_t i = 0; i < limited.size(); ++i) {
        limited[i]->diffuse = measured.materials[i].diffuse;
        limited[i]->specular = measured.materials[i].specular;
    }
}

using ColourOf = std::function<Spectrum(const SpectrumTable&)>;

/// \param scene materials before anything was put in.
void put_measured(std::vector<Material>& materials, const std::vector<Material>& scene,
                  const SpectralOptions& options, const Bands& bands, const ColourOf& colour_of,
                  Monitor& monitor) {
    for (std::size_t i = 0; i < materials.size(); ++i) {
        Material& m = materials[i];
        for (const MeasuredMaterial& measured : options.measured) {
            if (m.name != measured.name) continue;
            if (measured.reflectance) {
                m.diffuse = colour_of(*measured.reflectance);
                m.textures.diffuse = -1;
            }
            if (measured.specular) {
                m.specular = glm::max(colour_of(*measured.specular), Spectrum(least_specular));
                m.textures.specular = -1;
            }
            if (!measured.emission) continue;
            const double scale = measured.emission_scale.value_or(
                luminance(scene[i].emission) / luminance(bands.rgb_of(*measured.emission)));
            m.emission = static_cast<float>(scale) * colour_of(*measured.emission);
            m.textures.emission = -1;
        }
    }
    limit(materials, options, monitor);
}

}  // namespace

std::vector<MeasuredMaterial> read_measured_materials(const std::filesystem::path& path,
                                                      const std::vector<Material>& materials) {
    return Reader(path, materials).read();
}

Colours measured_colours(const Colours& rgb, const SpectralOptions& options, const Bands& bands,
                         Monitor& monitor) {
    Colours colours = rgb;
    const auto colour_of = [&](const SpectrumTable& table) {
        return glm::max(Spectrum(bands.rgb_of(table)), Spectrum(0.0f));
    };
    put_measured(colours.materials, rgb.materials, options, bands, colour_of, monitor);
    return colours;
}

Colours measured_colours_in_group(const Colours& rgb, const SpectralOptions& options,
                                  const Bands& bands, int group, Monitor& monitor) {
    Colours colours = colours_in_group(rgb, bands, group);
    const auto colour_of = [&](const SpectrumTable& table) { return bands.in_group(table, group); };
    put_measured(colours.materials, rgb.materials, options, bands, colour_of, monitor);
    return colours;
}

}  // namespace transillum
