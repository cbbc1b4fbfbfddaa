#include "cli/command.h"
#include "cli/console.h"
#include "cli/defect_json.h"
#include "cli/repair_options.h"
#include "cli/scene_options.h"

#include <transillum/base/error.h>
#include <transillum/repair/check_scene.h>
#include <transillum/solution/save_defects.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace transillum::cli {

namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
    MeshOptions mesh;
    std::string vtk, leak_path;
    LoadOptions load;
    CheckOptions check;
    bool no_leaks = false;
};

Json harmful_names() {
    Json names = Json::array();
    for (std::size_t d = 0; d < defect_count; ++d)
        if (is_harmful(static_cast<Defect>(d)))
            names.push_back(std::string(name_of(static_cast<Defect>(d))));
    return names;
}

Json describe(const CheckReport& r, const CheckOptions& options) {
    Json objects = Json::array(), components = Json::array(), leaks = Json::array();
    for (const ObjectCounts& o : r.objects)
        objects.push_back(
            {{"name", o.name}, {"triangles", o.triangles}, {"counts", counts_of(o.counts)}});
    for (const Component& c : r.components)
        components.push_back({{"faces", c.faces},
                              {"object", c.object},
                              {"closed", c.closed},
                              {"orientable", c.orientable},
                              {"volume", c.volume},
                              {"borders", c.borders}});
    for (const Leak& leak : r.leaks) {
        Json path = Json::array();
        for (const glm::dvec3& p : leak.path) path.push_back({p.x, p.y, p.z});
        leaks.push_back({{"from", leak.from},
                         {"length", leak.length},
                         {"width", std::isfinite(leak.width) ? Json(leak.width) : Json()},
                         {"opening", leak.is_opening},
                         {"path", path}});
    }
    return {{"polygons", r.polygons},
            {"triangles", r.triangles},
            {"vertices", r.vertices},
            {"diagonal", r.diagonal},
            {"thresholds",
             {{"near", r.tolerance},
              {"thin_wall", r.thin_wall},
              {"leak_width", options.leak_width * r.diagonal},
              {"needle", options.needle}}},
            {"sound", r.is_sound()},
            {"counts", counts_of(r.counts)},
            {"harmful", harmful_names()},
            {"objects", objects},
            {"components", components},
            {"thinnest_wall", r.thinnest_wall},
            {"leaks_searched", r.leaks_searched},
            {"leaks", leaks}};
}

void print_counts(const CheckReport& r) {
    for (std::size_t d = 0; d < defect_count; ++d) {
        const auto defect = static_cast<Defect>(d);
        if (r.counts[d] > 0)
            fmt::print("{} {:<20} {:>9}  {}\n", is_harmful(defect) ? '!' : ' ', name_of(defect),
                       r.counts[d], describe(defect));
    }
}

void print_objects(const CheckReport& r) {
    if (r.objects.size() < 2) return;
    for (const ObjectCounts& o : r.objects) {
        std::string line;
        for (std::size_t d = 0; d < defect_count; ++d)
            if (o.counts[d] > 0 && is_harmful(static_cast<Defect>(d)))
                line += fmt::format("{}{} {}", line.empty() ? "" : ", ",
                                    name_of(static_cast<Defect>(d)), o.counts[d]);
        if (!line.empty()) fmt::print("  '{}', {} triangles: {}\n", o.name, o.triangles, line);
    }
}

void print_components(const CheckReport& r) {
    std::uint64_t closed = 0, inside_out = 0, borders = 0;
    for (const Component& c : r.components) {
        closed += c.closed;
        inside_out += c.volume < 0.0;
        borders += c.borders;
    }
    fmt::print("components: {}; {} closed, {} of these inside out; {} loops of border edges\n",
               r.components.size(), closed, inside_out, borders);
}

void print_leaks(const CheckReport& r) {
    for (const Leak& leak : r.leaks)
        fmt::print("{} from {} to outside: {} wide, way of {:.4g}\n",
                   leak.is_opening ? "  opening" : "! leak", leak.from,
                   std::isfinite(leak.width) ? fmt::format("{:.4g}", leak.width) : "any",
                   leak.length);
    if (r.leaks_searched && r.leaks.empty())
        fmt::print("leaks: no way from outside to what luminaires and cameras see\n");
    if (!r.leaks_searched) fmt::print("leaks: not searched\n");
}

void print_text(const CheckReport& r, const CheckOptions& options) {
    fmt::print("{} triangles of {} polygons, {} vertices, {} objects; diagonal {:.6g}\n",
               r.triangles, r.polygons, r.vertices, r.objects.size(), r.diagonal);
    fmt::print(
        "near: within {:.3g}; thin walls: below {:.3g}; needles: height below {:g} of the "
        "longest edge\n",
        r.tolerance, r.thin_wall, options.needle);
    print_counts(r);
    print_objects(r);
    if (r.thinnest_wall > 0.0) fmt::print("thinnest wall: {:.3g}\n", r.thinnest_wall);
    print_components(r);
    print_leaks(r);
    std::uint64_t harmful = 0;
    for (std::size_t d = 0; d < defect_count; ++d)
        if (is_harmful(static_cast<Defect>(d))) harmful += r.counts[d];
    fmt::print("{}\n", harmful == 0 ? "nothing harmful"
                                    : fmt::format("{} harmful defects (those marked !)", harmful));
}

int run(const CheckArguments& a, const Common& common) {
    for (const std::string& path : {a.vtk, a.leak_path}) {
        if (path.empty()) continue;
        if (!path.ends_with(".vtp"))
            throw UsageError(path + "; accepted: a name that ends in .vtp");
        require_writable(path);
    }
    if (!a.vtk.empty() && a.vtk == a.leak_path)
        throw UsageError("--vtk and --leak-path " + a.vtk + "; accepted: two files");
    Console console(common);
    CheckOptions options = a.check;
    options.leaks = !a.no_leaks;
    const Scene scene = load_scene(a.mesh.scene, a.load, console);
    const CheckReport report = check_scene(scene, options, Workers(a.mesh.threads), console);
    console.end_progress();
    if (console.stop_requested()) return ExitCode::interrupted;
    if (!a.vtk.empty()) save_defects(report, scene, a.vtk);
    if (!a.leak_path.empty()) save_leaks(report.leaks, a.leak_path);
    if (a.mesh.json)
        fmt::print("{}\n", describe(report, options).dump(2));
    else
        print_text(report, options);
    return report.is_sound() ? ExitCode::done : ExitCode::bad_input;
}

void add_thresholds(CLI::App& command, CheckOptions& options) {
    const char* const group = "Thresholds";
    add_tolerance(command, options.tolerance, "vertices are near and edges passed by")
        ->group(group);
    const auto add = [&](const char* name, double& value, const char* help) {
        command.add_option(name, value, help)
            ->check(within(0.0, 1.0))
            ->capture_default_str()
            ->group(group);
    };
    add("--needle", options.needle, "height over longest edge, below which a face is a needle");
    add("--thin-wall", options.thin_wall,
        "thickness over the diagonal, below which a wall is thin");
    add("--leak-width", options.leak_width,
        "width over the diagonal, from which a way out is an opening and no leak");
}

}  // namespace

void add_check(CLI::App& program, const Common& common, int& exit_code) {
    auto a = std::make_shared<CheckArguments>();
    CLI::App* command =
        program.add_subcommand("check", "What is wrong with a scene's meshes; changes nothing");
    add_mesh_options(*command, a->mesh);
    command->add_option("--vtk", a->vtk, "write the defects there: .vtp, see its array Defect");
    command->add_option("--leak-path", a->leak_path,
                        "write the ways from luminaires and cameras to outside there: .vtp");
    command->add_flag("--no-leaks", a->no_leaks, "don't search for ways to outside");
    add_thresholds(*command, a->check);
    add_load_options(*command, a->load);
    command->footer(
        "Exit codes: 0 nothing harmful, 3 something harmful or a bad scene, others as "
        "of the program.");
    command->footer(
        "Examples:\n"
        "  transillum check room.obj\n"
        "  transillum check room.obj --vtk defects.vtp --leak-path leaks.vtp");
    command->callback([a, &common, &exit_code] { exit_code = run(*a, common); });
}

}  // namespace transillum::cli
