#include "cli/command.h"

#include <transillum/solution/load_solution.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace transillum::cli {

namespace {

using Json = nlohmann::ordered_json;

Json channels(const SpectrumSum& s) {
    return {s.x, s.y, s.z};
}

/// Area-weighted over the patches that reflect.
Json mean_irradiance(const Solution& s, const std::vector<Spectrum>& irradiance) {
    SpectrumSum sum(0.0);
    double area = 0.0;
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        if (!s.reflects(p) || s.coverage[p] == 0.0f) continue;
        const double a = area_of_leaf(s.surface, s.patches, s.patches.leaf_of_patch(p));
        sum += a * SpectrumSum(irradiance[p]);
        area += a;
    }
    return channels(area > 0.0 ? sum / area : sum);
}

Json describe(const Solution& s, const RunRecord& run) {
    Json cameras = Json::array(), decisions = Json::array(), settings = Json::object(),
         seconds = Json::object();
    for (const Camera& c : s.cameras) cameras.push_back(c.name);
    for (const Decision& d : s.decisions) decisions.push_back(d.what + ": " + d.why);
    for (const auto& [name, value] : s.settings) settings[name] = value;
    for (const auto& [phase, time] : run.seconds) seconds[phase] = time;
    return {{"triangles", s.surface.triangles.size()},
            {"materials", s.surface.materials.size()},
            {"objects", s.surface.objects.size()},
            {"patches", s.patches.patch_count()},
            {"light_samples", s.direct.samples.size()},
            {"light_vectors", s.direct.first_samples.size()},
            {"iterations", s.iterations},
            {"relative_error", s.relative_error},
            {"interrupted", s.interrupted},
            {"mean_direct_irradiance", mean_irradiance(s, s.direct_irradiance)},
            {"mean_indirect_irradiance", mean_irradiance(s, s.indirect_irradiance)},
            {"flux",
             {{"emitted", channels(s.balance.emitted)},
              {"entered", channels(s.balance.entered)},
              {"absorbed", channels(s.balance.absorbed)},
              {"escaped", channels(s.balance.escaped)},
              {"black_backs", channels(s.balance.black_backs)}}},
            {"cameras", cameras},
            {"decisions", decisions},
            {"settings", settings},
            {"scene_hash", s.scene_hash},
            {"threads", run.threads},
            {"seconds", seconds},
            {"command_line", run.command_line}};
}

std::string rgb(const Json& v) {
    return fmt::format("{:.6g} {:.6g} {:.6g}", v[0].get<double>(), v[1].get<double>(),
                       v[2].get<double>());
}

void print_text(const Json& j) {
    const auto line = [](const std::string& name, const std::string& value) {
        fmt::print("{:<22} {}\n", name, value);
    };
    line("triangles", fmt::format("{} in {} objects, {} materials", j["triangles"].dump(),
                                  j["objects"].dump(), j["materials"].dump()));
    line("patches", j["patches"].dump());
    line("light samples", j["light_samples"].dump());
    if (j["light_vectors"] > 0) line("light vectors", j["light_vectors"].dump() + " a patch");
    line("iterations",
         j["iterations"].dump() + (j["interrupted"].get<bool>() ? " (interrupted)" : ""));
    line("estimated error", fmt::format("{:.3f} %", 100.0 * j["relative_error"].get<double>()));
    line("direct irradiance", rgb(j["mean_direct_irradiance"]) + "  W m^-2, mean");
    line("indirect irradiance", rgb(j["mean_indirect_irradiance"]) + "  W m^-2, mean");
    for (const auto& [name, value] : j["flux"].items()) line("flux " + name, rgb(value));
    for (const auto& c : j["cameras"]) line("camera", c.get<std::string>());
    for (const auto& d : j["decisions"]) line("decision", d.get<std::string>());
    for (const auto& [name, value] : j["settings"].items())
        line("--" + name, value.get<std::string>());
    for (const auto& [name, value] : j["seconds"].items())
        line("time, " + name, fmt::format("{:.2f} s", value.get<double>()));
    line("scene hash", j["scene_hash"].get<std::string>());
}

}  // namespace

void add_info(CLI::App& program, const Common&, int& exit_code) {
    struct InfoArguments {
        std::string solution;
        bool json = false;
    };
    auto a = std::make_shared<InfoArguments>();
    CLI::App* command =
        program.add_subcommand("info", "What a solution holds, how it was made and how good it is");
    command->add_option("SOLUTION", a->solution, "what bake wrote: NAME.vtm")->required();
    command->add_flag("--json", a->json, "machine-readable");
    command->footer(
        "Example:\n"
        "  transillum info room.vtm");
    command->callback([a, &exit_code] {
        const Json json = describe(load_solution(a->solution), load_run_record(a->solution));
        if (a->json)
            fmt::print("{}\n", json.dump(2));
        else
            print_text(json);
        exit_code = ExitCode::done;
    });
}

}  // namespace transillum::cli
