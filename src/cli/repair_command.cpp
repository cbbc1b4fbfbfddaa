#include "cli/command.h"
#include "cli/console.h"
#include "cli/defect_json.h"
#include "cli/repair_options.h"
#include "cli/scene_options.h"

#include <transillum/base/error.h>
#include <transillum/repair/check_scene.h>
#include <transillum/repair/repair_scene.h>
#include <transillum/repair/triangulate_scene.h>
#include <transillum/scene/save_scene.h>

#include <fmt/format.h>

#include <memory>

namespace transillum::cli {

namespace {

struct RepairArguments {
    MeshOptions mesh;
    std::string output;
    RepairOptions repair;
    bool no_check = false;
};

struct Checks {
    CheckReport before, after;
};

void print_json(const RepairArguments& a, const RepairReport& r, const Checks* checks) {
    auto steps = nlohmann::ordered_json::array();
    for (const RepairStep& step : r.steps)
        steps.push_back({{"what", step.what}, {"count", step.count}});
    nlohmann::ordered_json json{{"scene", a.mesh.scene},
                                {"output", a.output},
                                {"welded_vertices", r.welded},
                                {"steps", steps},
                                {"crossing_pairs", r.crossing_pairs},
                                {"coplanar_pairs", r.coplanar_pairs},
                                {"faces_cut", r.faces_cut},
                                {"faces_made", r.faces_made},
                                {"vertices_made", r.vertices_made},
                                {"rounds", r.rounds},
                                {"largest_move", r.largest_move},
                                {"pairs_left", r.pairs_left},
                                {"left", r.left}};
    if (checks) {
        json["before"] = counts_of(checks->before.counts);
        json["after"] = counts_of(checks->after.counts);
        json["sound"] = checks->after.is_sound();
    }
    fmt::print("{}\n", json.dump(2));
}

void print_text(const RepairArguments& a, const RepairReport& r, const Checks* checks) {
    if (!r.changed() && r.welded == 0) fmt::print("nothing to repair\n");
    if (r.welded > 0) fmt::print("{:>9}  welded vertices at one place\n", r.welded);
    for (const RepairStep& step : r.steps) fmt::print("{:>9}  {}\n", step.count, step.what);
    if (r.faces_made > 0)
        fmt::print(
            "{} crossing and touching pairs and {} overlaps resolved in {} rounds: {} faces "
            "became {}, with {} new vertices\n",
            r.crossing_pairs, r.coplanar_pairs, r.rounds, r.faces_cut, r.faces_made,
            r.vertices_made);
    if (r.largest_move > 0.0) fmt::print("no vertex moved by more than {:.3g}\n", r.largest_move);
    for (const std::string& left : r.left) fmt::print("! left: {}\n", left);
    if (checks) {
        fmt::print("\n  {:<20} {:>9} {:>9}\n", "defects", "before", "after");
        for (std::size_t d = 0; d < defect_count; ++d) {
            const auto defect = static_cast<Defect>(d);
            const auto before = checks->before.counts[d], after = checks->after.counts[d];
            if (before + after > 0)
                fmt::print("{} {:<20} {:>9} {:>9}\n", is_harmful(defect) ? '!' : ' ',
                           name_of(defect), before, after);
        }
        fmt::print("{}\n", checks->after.is_sound() ? "nothing harmful (!) is left"
                                                    : "what is harmful (!) is not all repaired");
    }
    fmt::print("{}\n", a.output);
}

int run(RepairArguments& a, const Common& common) {
    const bool polygons = holds_polygons(a.output);
    require_writable(a.output);
    Console console(common);
    const Workers workers(a.mesh.threads);
    const Scene scene = load_scene(a.mesh.scene, {}, console);
    // STL and glTF hold floats: what is made has to be sound among these.
    a.repair.rounding = polygons ? Rounding::doubles : Rounding::floats;
    CheckOptions check;
    check.tolerance = a.repair.tolerance;
    check.leaks = false;
    Checks checks;
    if (!a.no_check) checks.before = check_scene(scene, check, workers, console);
    RepairedScene repaired = repair_scene(scene, a.repair, workers, console);
    if (console.stop_requested()) return ExitCode::interrupted;
    if (repaired.scene.polygons.empty())
        throw InputError(a.mesh.scene, "no face with an area is left; accepted: at least one");
    if (!polygons) triangulate_scene(repaired.scene);
    save_scene(repaired.scene, a.output, console);
    if (!a.no_check) checks.after = check_scene(repaired.scene, check, workers, console);
    console.end_progress();
    (a.mesh.json ? print_json : print_text)(a, repaired.report, a.no_check ? nullptr : &checks);
    return ExitCode::done;
}

}  // namespace

void add_repair(CLI::App& program, const Common& common, int& exit_code) {
    auto a = std::make_shared<RepairArguments>();
    CLI::App* command = program.add_subcommand(
        "repair", "Make a scene's meshes sound, exactly, and say what was done");
    add_mesh_options(*command, a->mesh);
    command->add_option("-o,--output", a->output, "scene to write, of any of these formats")
        ->required();
    add_repair_options(*command, "--level", a->repair);
    command->add_flag("--no-check", a->no_check, "don't count defects before and after");
    command->footer(
        "Exit codes: 0 also where something harmful is left, which is told; 'check' of what was "
        "written exits with 3 then.");
    command->footer(
        "Example:\n"
        "  transillum repair room.obj -o sound.obj");
    command->callback([a, &common, &exit_code] { exit_code = run(*a, common); });
}

}  // namespace transillum::cli
