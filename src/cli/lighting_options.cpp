#include "cli/lighting_options.h"

#include "cli/scene_options.h"

#include <transillum/base/error.h>
#include <transillum/scene/load_environment.h>
#include <transillum/scene/photometry.h>
#include <transillum/scene/read_ies.h>
#include <transillum/scene/split_sun.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <filesystem>
#include <map>

namespace transillum::cli {

namespace {

constexpr const char* environments =
    "none, uniform:L, overcast:L, clear:L,AZIMUTH,ELEVATION, or an image (.hdr, .exr)";

/// A value of an option, and what may stand in its place.
struct Word {
    const char* option;
    const std::string& text;
    std::string accepted;
    [[noreturn]] void fail(const std::string& what) const {
        throw UsageError(fmt::format("{} {}: {}; accepted: {}", option, text, what, accepted));
    }
};

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find(at, begin)) != std::string::npos; begin = end + 1)
        parts.push_back(text.substr(begin, end - begin));
    parts.push_back(text.substr(begin));
    return parts;
}

std::vector<double> numbers(const Word& word, const std::string& text) {
    std::vector<double> values;
    for (const std::string& part : split(text, ',')) {
        double value = 0.0;
        if (!CLI::detail::lexical_cast(part, value) || !std::isfinite(value))
            word.fail("'" + part + "' is no number");
        values.push_back(value);
    }
    return values;
}

/// One number for all channels, or one each.
Spectrum spectrum(const Word& word, const std::vector<double>& values) {
    if (values.size() != 1 && values.size() != 3)
        word.fail(fmt::format("{} numbers where light has 1 or 3", values.size()));
    Spectrum result;
    for (int c = 0; c < channel_count; ++c) {
        const double value = values[values.size() == 1 ? 0 : static_cast<std::size_t>(c)];
        result[c] = static_cast<float>(value);
        if (!(value >= 0.0 && std::isfinite(result[c]))) word.fail("light is negative or too much");
    }
    return result;
}

glm::dvec3 vector(const Word& word, const std::vector<double>& values) {
    if (values.size() != 3)
        word.fail(fmt::format("{} numbers where a vector has 3", values.size()));
    return {values[0], values[1], values[2]};
}

glm::dvec3 unit(const Word& word, const glm::dvec3& v) {
    const double length = glm::length(v);
    if (!(length > 0.0 && std::isfinite(length))) word.fail("a direction has a length");
    return v / length;
}

glm::dvec3 up_of(const LightingOptions& options) {
    const std::map<std::string, glm::dvec3> axes{
        {"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}};
    if (const auto axis = axes.find(options.up); axis != axes.end()) return axis->second;
    const Word word{"--environment-up", options.up, "x, y, z or X,Y,Z"};
    return unit(word, vector(word, numbers(word, options.up)));
}

void read_clear_sky(const Word& word, std::vector<double> values, Environment& environment) {
    if (values.size() < 3) word.fail("the sun's azimuth and elevation are missing");
    const double elevation = values.back(), azimuth = values[values.size() - 2];
    if (!(elevation >= 0.0 && elevation <= 90.0))
        word.fail(fmt::format("elevation {:g} is not in [0, 90] degrees", elevation));
    values.resize(values.size() - 2);
    environment.radiance_scale = spectrum(word, values);
    environment.sun = sky_direction(environment.up, glm::radians(azimuth), glm::radians(elevation));
}

Environment read_environment(const LightingOptions& options, Monitor& monitor) {
    const Word word{"--environment", options.environment, environments};
    const std::map<std::string, Environment::Kind> kinds{{"uniform", Environment::Kind::uniform},
                                                         {"overcast", Environment::Kind::overcast},
                                                         {"clear", Environment::Kind::clear}};
    const std::size_t colon = options.environment.find(':');
    const auto kind = kinds.find(options.environment.substr(0, colon));
    Environment environment;
    if (kind != kinds.end() && colon != std::string::npos) {
        environment.kind = kind->second;
        environment.up = up_of(options);
        const std::vector<double> values = numbers(word, options.environment.substr(colon + 1));
        if (environment.kind == Environment::Kind::clear)
            read_clear_sky(word, values, environment);
        else
            environment.radiance_scale = spectrum(word, values);
    } else {
        const std::filesystem::path path(options.environment);
        std::error_code ignored;
        const bool is_word = colon != std::string::npos || !path.has_extension();
        if (is_word && !std::filesystem::exists(path, ignored)) word.fail("not understood");
        environment = load_environment(path, monitor);
        environment.up = up_of(options);
        environment.rotation = glm::radians(options.environment_rotation);
    }
    environment.radiance_scale *= static_cast<float>(options.environment_scale);
    if (!is_finite(environment.radiance_scale)) word.fail("scaled, it is too much");
    return environment;
}

void move_suns(Lighting& lighting, Monitor& monitor) {
    const Suns suns = split_sun(lighting.environment);
    if (suns.lights.empty()) return;
    monitor.note(
        fmt::format("{:.0f} % of the environment shines from {} small spot{}, which "
                    "become{} directional light{} (--keep-suns)",
                    100.0 * suns.share, suns.lights.size(), suns.lights.size() == 1 ? "" : "s",
                    suns.lights.size() == 1 ? "s a" : "", suns.lights.size() == 1 ? "" : "s"));
    lighting.lights.insert(lighting.lights.end(), suns.lights.begin(), suns.lights.end());
}

PunctualLight read_light(const std::string& text, std::size_t number) {
    const Word word{"--light", text,
                    "[NAME=]point:X,Y,Z:I, [NAME=]spot:X,Y,Z:DX,DY,DZ:INNER,OUTER:I or "
                    "[NAME=]directional:DX,DY,DZ:E"};
    PunctualLight light;
    const std::size_t equals = text.find('=');
    light.name =
        equals == std::string::npos ? fmt::format("light {}", number) : text.substr(0, equals);
    const auto parts = split(equals == std::string::npos ? text : text.substr(equals + 1), ':');
    const std::map<std::string, std::pair<PunctualLight::Kind, std::size_t>> kinds{
        {"point", {PunctualLight::Kind::point, 3}},
        {"spot", {PunctualLight::Kind::spot, 5}},
        {"directional", {PunctualLight::Kind::directional, 3}}};
    const auto kind = kinds.find(parts[0]);
    if (kind == kinds.end() || parts.size() != kind->second.second) word.fail("not understood");
    light.kind = kind->second.first;
    light.intensity = spectrum(word, numbers(word, parts.back()));
    const glm::dvec3 first = vector(word, numbers(word, parts[1]));
    if (light.kind == PunctualLight::Kind::directional) {
        light.direction = unit(word, first);
        return light;
    }
    light.position = first;
    if (light.kind == PunctualLight::Kind::point) return light;
    light.direction = unit(word, vector(word, numbers(word, parts[2])));
    const std::vector<double> cone = numbers(word, parts[3]);
    if (cone.size() != 2 || !(cone[0] >= 0.0 && cone[0] < cone[1] && cone[1] <= 90.0))
        word.fail("half-angles are not 0 <= INNER < OUTER <= 90 degrees");
    light.inner_angle = glm::radians(cone[0]);
    light.outer_angle = glm::radians(cone[1]);
    return light;
}

std::string names_of(const std::vector<PunctualLight>& lights) {
    std::string names;
    for (const PunctualLight& light : lights)
        if (light.kind != PunctualLight::Kind::directional)
            names += (names.empty() ? "" : ", ") + light.name;
    return names.empty() ? "none, as the scene has no point or spot light" : names;
}

}  // namespace

void add_lighting_options(CLI::App& command, LightingOptions& options) {
    const char* const group = "Light from no surface";
    command
        .add_option("--environment", options.environment,
                    fmt::format("{}. L: radiance [W sr^-1 m^-2], of skies at the zenith; one "
                                "number or R,G,B. Azimuth clockwise from north (-z for y up, +y "
                                "for z up), elevation of the sun [degrees]",
                                environments))
        ->type_name("SKY")
        ->capture_default_str()
        ->group(group);
    command
        .add_option("--environment-rotation", options.environment_rotation,
                    "azimuth of the image's left edge [degrees]")
        ->check(within(-360.0, 360.0))
        ->capture_default_str()
        ->group(group);
    command.add_option("--environment-scale", options.environment_scale, "factor on its radiance")
        ->check(within(0.0, 1e30))
        ->capture_default_str()
        ->group(group);
    command
        .add_flag("--keep-suns", options.keep_suns,
                  "leave an image's suns in it (else they become directional lights)")
        ->group(group);
    command.add_option("--environment-up", options.up, "zenith: x, y, z or X,Y,Z")
        ->type_name("AXIS")
        ->capture_default_str()
        ->group(group);
    command
        .add_option("--light", options.lights,
                    "adds [NAME=]point:X,Y,Z:I, [NAME=]spot:X,Y,Z:DX,DY,DZ:INNER,OUTER:I "
                    "(half-angles [degrees]) or [NAME=]directional:DX,DY,DZ:E; I [W sr^-1], "
                    "E [W m^-2], one number or R,G,B; repeatable")
        ->type_name("LIGHT")
        ->allow_extra_args(false)
        ->group(group);
    command
        .add_option("--light-photometry", options.photometry,
                    "IES file: how a point or spot light of that name shines; repeatable")
        ->type_name("NAME=FILE")
        ->allow_extra_args(false)
        ->group(group);
}

Lighting make_lighting(const LightingOptions& options, Monitor& monitor) {
    Lighting lighting;
    for (const std::string& text : options.lights)
        lighting.lights.push_back(read_light(text, lighting.lights.size() + 1));
    if (options.environment == "none") return lighting;
    lighting.environment = read_environment(options, monitor);
    if (!options.keep_suns) move_suns(lighting, monitor);
    return lighting;
}

void hang_photometry(const LightingOptions& options, Scene& scene, Monitor& monitor) {
    for (const std::string& text : options.photometry) {
        const Word word{"--light-photometry", text, "NAME=FILE.ies"};
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos) word.fail("no '='");
        const std::string name = text.substr(0, equals);
        const auto table =
            std::make_shared<const Photometry>(read_ies(text.substr(equals + 1), monitor));
        bool found = false;
        for (PunctualLight& light : scene.lighting.lights) {
            if (light.name != name || light.kind == PunctualLight::Kind::directional) continue;
            found = true;
            light.kind = PunctualLight::Kind::point;
            light.photometry = table;
            const float strength = luminance(light.intensity);
            light.intensity = strength > 0.0f ? light.intensity / strength : Spectrum(1.0f);
        }
        if (!found)
            throw UsageError(
                fmt::format("--light-photometry {}: no point or spot light '{}'; "
                            "accepted: {}",
                            text, name, names_of(scene.lighting.lights)));
    }
}

}  // namespace transillum::cli
