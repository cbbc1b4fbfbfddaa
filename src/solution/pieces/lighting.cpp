#include "members.h"
#include "pieces.h"

#include <transillum/base/error.h>
#include <transillum/scene/photometry.h>

#include <algorithm>

namespace transillum {

namespace {

using Tables = std::vector<std::shared_ptr<const Photometry>>;

template <class Each>
void for_light_members(Each each) {
    each("LightName", &PunctualLight::name);
    each("LightKind", &PunctualLight::kind);
    each("LightPosition", &PunctualLight::position);
    each("LightDirection", &PunctualLight::direction);
    each("LightUp", &PunctualLight::up);
    each("LightIntensity", &PunctualLight::intensity);
    each("LightInnerAngle", &PunctualLight::inner_angle);
    each("LightOuterAngle", &PunctualLight::outer_angle);
}

/// The numbers of all tables, one behind the other; how many of each is told beside.
template <class Each>
void for_table_members(Each each) {
    each("PhotometryVertical", "PhotometryVerticalCount", &Photometry::vertical);
    each("PhotometryHorizontal", "PhotometryHorizontalCount", &Photometry::horizontal);
    each("PhotometryCandela", "PhotometryCandelaCount", &Photometry::candela);
}

/// Several lights may share one.
Tables tables_of(const std::vector<PunctualLight>& lights) {
    Tables tables;
    for (const PunctualLight& light : lights)
        if (light.photometry && std::ranges::count(tables, light.photometry) == 0)
            tables.push_back(light.photometry);
    return tables;
}

void add_photometry(const std::vector<PunctualLight>& lights, vtkFieldData& fields) {
    const Tables tables = tables_of(lights);
    add_array(fields, "LightPhotometry", lights.size(), [&](std::size_t i) {
        if (!lights[i].photometry) return std::int32_t{-1};
        return static_cast<std::int32_t>(std::ranges::find(tables, lights[i].photometry) -
                                         tables.begin());
    });
    std::vector<std::string> names;
    for (const auto& table : tables) names.push_back(table->name);
    add_strings(fields, "PhotometryName", names);
    for_table_members([&](const char* name, const char* count, auto member) {
        std::vector<double> all;
        for (const auto& table : tables)
            all.insert(all.end(), ((*table).*member).begin(), ((*table).*member).end());
        add_array(fields, name, all.size(), [&](std::size_t i) { return all[i]; });
        add_array(fields, count, tables.size(), [&](std::size_t i) {
            return static_cast<std::uint32_t>(((*tables[i]).*member).size());
        });
    });
}

void read_photometry(const ArrayReader& reader, std::vector<PunctualLight>& lights) {
    std::vector<Photometry> tables;
    for (const std::string& name : reader.read_strings("PhotometryName"))
        tables.push_back({name, {}, {}, {}});
    for_table_members([&](const char* name, const char* count, auto member) {
        const auto counts = reader.read<std::uint32_t>(count, tables.size());
        std::size_t total = 0;
        for (const std::uint32_t n : counts) total += n;
        const double* in = reader.find<double>(name, total, 1);
        for (std::size_t i = 0; i < tables.size(); in += counts[i++])
            (tables[i].*member).assign(in, in + counts[i]);
    });
    Tables shared;
    for (Photometry& table : tables)
        shared.push_back(std::make_shared<const Photometry>(std::move(table)));
    const auto indices = reader.read<std::int32_t>("LightPhotometry", lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (indices[i] < -1 || indices[i] >= static_cast<std::int64_t>(shared.size()))
            throw InputError(reader.file.string(),
                             "array 'LightPhotometry': " + std::to_string(indices[i]) + " of " +
                                 std::to_string(shared.size()));
        if (indices[i] >= 0) lights[i].photometry = shared[static_cast<std::size_t>(indices[i])];
    }
}

}  // namespace

void add_lighting(const Lighting& lighting, vtkFieldData& fields) {
    for_light_members(
        [&](const char* name, auto member) { add_member(fields, name, lighting.lights, member); });
    add_photometry(lighting.lights, fields);
    const Environment& environment = lighting.environment;
    add_value(fields, "EnvironmentKind", static_cast<std::uint8_t>(environment.kind));
    add_value(fields, "EnvironmentRadianceScale", environment.radiance_scale);
    add_value(fields, "EnvironmentUp", environment.up);
    add_value(fields, "EnvironmentRotation", environment.rotation);
    add_value(fields, "EnvironmentSun", environment.sun);
}

void read_lighting(vtkFieldData& fields, const Path& file, Lighting& lighting) {
    const ArrayReader reader{fields, file};
    lighting.lights.resize(reader.read_strings("LightName").size());
    for_light_members(
        [&](const char* name, auto member) { read_member(reader, name, lighting.lights, member); });
    read_photometry(reader, lighting.lights);
    Environment& environment = lighting.environment;
    environment.kind = Environment::Kind(reader.read_value<std::uint8_t>("EnvironmentKind"));
    environment.radiance_scale = reader.read_value<Spectrum>("EnvironmentRadianceScale");
    environment.up = reader.read_value<glm::dvec3>("EnvironmentUp");
    environment.rotation = reader.read_value<double>("EnvironmentRotation");
    environment.sun = reader.read_value<glm::dvec3>("EnvironmentSun");
}

}  // namespace transillum
