#include "cli/bake_output.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/repair_options.h"
#include "cli/scene_options.h"
#include "cli/spectral_options.h"

#include <transillum/base/error.h>
#include <transillum/solution/bake.h>
#include <transillum/solution/bake_bands.h>
#include <transillum/solution/bake_emitters.h>
#include <transillum/solution/load_solution.h>
#include <transillum/solution/save_solution.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

namespace transillum::cli {

namespace {

/// Share of the flux on black backs from which a mesh is suspect; the backs of lamps take some.
constexpr double most_lost = 0.01;

struct BakeArguments {
    SceneOptions scene;
    std::string output;
    BakeOptions bake;
    SpectralArguments spectral;
    double memory = 0.0;
    bool keep_phases = false, again = false, keep_emitters = false;
    int threads = 0;
};

void add_options(CLI::App& command, BakeArguments& a) {
    add_scene_options(command, a.scene);
    add_spectral_options(command, a.spectral);
    command.add_option("-o,--output", a.output, "solution to write, NAME.vtm (and a folder NAME)")
        ->required()
        ->group("Output");
    command
        .add_flag("--again", a.again,
                  "bake even where OUTPUT is the solution of this scene and these options already")
        ->group("Output");
    a.bake.iteration.keep_sums = true;
    add_choice(command, "--keep-sums", a.bake.iteration.keep_sums, {{"on", true}, {"off", false}},
               "what resume needs to go on, in NAME/sums.vtp (not of --spectral or "
               "--keep-emitters)")
        ->group("Output");
    command
        .add_flag("--keep-emitters", a.keep_emitters,
                  "transport the light of every emitter alone, which takes as many times as long, "
                  "so that relight can dim and tint them without another bake")
        ->group("Output");

    auto& iteration = a.bake.iteration;
    const char* const stopping = "Stopping (whichever comes first)";
    command
        .add_option("--iterations", iteration.iterations,
                    "directions, each transferred both ways; best a power of two")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31))
        ->capture_default_str()
        ->group(stopping);
    command
        .add_option(
            "--target-error", iteration.target_error,
            "relative error, as 0.01; 0: none. The estimate is held below it by a sixth or more")
        ->check(within(0.0, 1.0))
        ->capture_default_str()
        ->group(stopping);
    command
        .add_option("--time", iteration.seconds,
                    "seconds of transport, of every phase; 0: no limit")
        ->check(not_negative())
        ->capture_default_str()
        ->group(stopping);

    const char* const patches = "Patches";
    command
        .add_option("--leaves", a.bake.subdivision.leaf_target,
                    "about so many leaf patches, alike in size; 0: 30000 more than triangles or "
                    "twice as many, as far as these are large")
        ->check(CLI::Range(0u, 1u << 28))
        ->capture_default_str()
        ->group(patches);
    command
        .add_option("--patch-size", a.bake.subdivision.patch_size,
                    "longest edge of a leaf [scene units], instead of --leaves")
        ->check(not_negative())
        ->capture_default_str()
        ->group(patches);
    command
        .add_option("--max-level", a.bake.subdivision.max_level, "most subdivisions of a triangle")
        ->check(CLI::Range(0, max_subdivision_level))
        ->capture_default_str()
        ->group(patches);
    command
        .add_option("--crease-angle", a.bake.surface.crease_angle,
                    "sharper edges are not shaded across [degrees]")
        ->check(within(0.0, 180.0))
        ->capture_default_str()
        ->group(patches);

    add_repair_options(command, "--repair", a.bake.repair);

    const char* const refinement = "Refinement";
    auto& refine = a.bake.refinement;
    command
        .add_option("--refine", refine.phases,
                    "most phases, each of which splits leaves that are too coarse")
        ->check(CLI::Range(0, max_subdivision_level))
        ->capture_default_str()
        ->group(refinement);
    command
        .add_option("--refine-tolerance", refine.tolerance,
                    "of the radiance of quarters that meet, over the scene's mean")
        ->check(within(1e-6, 1e6))
        ->capture_default_str()
        ->group(refinement);
    command
        .add_option("--max-leaves", refine.max_leaves,
                    "of the refined patches; 0: four times as many as at first")
        ->check(CLI::Range(0u, 1u << 28))
        ->capture_default_str()
        ->group(refinement);
    add_choice(command, "--refine-for", refine.direct, {{"stored", true}, {"traced", false}},
               "how pictures are going to show direct light: stored takes its shadows' edges along")
        ->group(refinement);
    command
        .add_flag("--phases", a.keep_phases,
                  "keep every phase: NAME-phases.pvd (and a folder) for ParaView to play")
        ->group(refinement);

    const char* const method = "Method";
    add_choice(command, "--first-shot", a.bake.light.first_shot,
               {{"auto", FirstShot::automatic},
                {"off", FirstShot::off},
                {"hemicube", FirstShot::hemicube},
                {"vectors", FirstShot::vectors}},
               "direct light by light samples: auto: of small luminaires; hemicube: of all; "
               "vectors: of all, but kept as one vector a luminaire and patch, which takes less "
               "memory and blurs glossy highlights")
        ->group(method);
    command
        .add_option("--light-samples", a.bake.light.samples,
                    "a luminaire; 0: 4 to 64, by how many luminaires there are")
        ->check(CLI::Range(0, 4096))
        ->capture_default_str()
        ->group(method);
    command.add_option("--hemicube", a.bake.hemicube_resolution, "pixels along its edge, even")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str()
        ->group(method);
    command
        .add_option("--resolution", a.bake.resolution,
                    "pixels across the transillumination buffer; 0: three a leaf's edge")
        ->check(CLI::Range(0, 8192))
        ->capture_default_str()
        ->group(method);
    add_choice(command, "--brdf-bins", a.bake.bins.level,
               {{"auto", -1}, {"1", 0}, {"4", 1}, {"16", 2}, {"64", 3}},
               "direction bins of glossy patches; auto: by the width and weight of the lobe, and "
               "with --refine by the light")
        ->group(method);
    command
        .add_option("--memory", a.memory,
                    "most GiB that tables may take; 0: nine tenths of the machine's")
        ->check(not_negative())
        ->capture_default_str()
        ->group(method);
    add_choice(command, "--monte-carlo", iteration.monte_carlo,
               {{"auto", MonteCarlo::automatic},
                {"off", MonteCarlo::off},
                {"subpatch", MonteCarlo::subpatch},
                {"wavefront", MonteCarlo::wavefront}},
               "what patches can't hold is carried from bundle to bundle on their quarters, or in "
               "the whole buffer; auto: where it changes more than the error to be expected")
        ->group(method);
    add_choice(command, "--dark-rooms", a.bake.dark_rooms,
               {{"auto", DarkRooms::automatic}, {"keep", DarkRooms::keep}},
               "rooms that no light reaches; auto: left out of the transport")
        ->group(method);
    add_choice(
        command, "--averaging", iteration.averaging,
        {{"balanced", Averaging::balanced}, {"paper", Averaging::paper}, {"none", Averaging::none}},
        "how iterations are averaged; for comparison, paper: 1/m; none: plain ray bundles, "
        "nothing is fed back but the last")
        ->group(method);
    command.add_option("--seed", a.bake.seed, "of the directions and light samples")
        ->capture_default_str()
        ->group(method);
    command
        .add_option("--threads", a.threads,
                    "0: as many as the machine has; the result does not depend on it")
        ->capture_default_str()
        ->group(method);
}

/// Saves phases as they come, and the list that ParaView plays.
class PhaseKeeper {
public:
    explicit PhaseKeeper(const std::filesystem::path& output)
        : folder_(output.parent_path() / (output.stem().string() + "-phases")),
          list_(folder_.string() + ".pvd") {
        std::filesystem::create_directories(folder_);
    }
    void keep(const Solution& phase, int number, const std::string& command_line) {
        const std::string name = fmt::format("phase-{:02}.vtm", number);
        save_solution(phase, {command_line, 0, {}}, folder_ / name);
        entries_ += fmt::format("    <DataSet timestep=\"{}\" file=\"{}/{}\"/>\n", number,
                                folder_.filename().string(), name);
        std::ofstream list(list_);
        list << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n"
             << "  <Collection>\n"
             << entries_ << "  </Collection>\n</VTKFile>\n";
        if (!list.flush()) throw IoError(list_, "cannot be written");
    }

private:
    std::filesystem::path folder_;
    std::string list_, entries_;
};

int run(BakeArguments& a, const Common& common) {
    Console console(common);
    if (!a.output.ends_with(".vtm"))
        throw UsageError("--output " + a.output + "; accepted: a name that ends in .vtm");
    if (a.bake.resolution > 0 && a.bake.resolution < 16)
        throw UsageError("--resolution " + std::to_string(a.bake.resolution) +
                         "; accepted: 0 or 16 to 8192");
    require_writable(a.output);
    if (a.keep_phases && a.bake.refinement.phases == 0)
        throw UsageError("--phases without any; accepted: together with --refine");
    a.bake.memory = allowed_memory(a.memory);
    const Workers workers(a.threads);
    const Scene scene = read_scene(a.scene, console);
    std::optional<PhaseKeeper> keeper;
    if (a.keep_phases) {
        keeper.emplace(a.output);
        a.bake.refinement.keep_phase = [&](const Solution& phase, int number) {
            keeper->keep(phase, number, common.command_line);
        };
    }
    RunRecord record;
    record.command_line = common.command_line;
    const auto spectral = make_spectral_options(a.spectral, a.scene.max_albedo, scene);
    if (spectral && a.keep_emitters)
        throw UsageError("--keep-emitters with --spectral; accepted: one of them");
    if (!a.again && !a.keep_phases && !a.keep_emitters && !spectral)
        if (const auto solution = find_baked(a.output, hash_input(scene, a.bake))) {
            console.note(a.output +
                         ": unchanged: it was baked from this scene and these options (--again "
                         "bakes anew)");
            print_summary(*solution, a.output);
            return ExitCode::done;
        }
    SpectralSolution baked;
    EmitterSolution by_emitters;
    if (a.keep_emitters)
        by_emitters = bake_emitters(scene, a.bake, workers, console, &record);
    else if (spectral)
        baked = bake_bands(scene, *spectral, a.bake, workers, console, &record);
    else
        baked.rgb = bake(scene, a.bake, workers, console, &record);
    Solution& solution = a.keep_emitters ? by_emitters.all : baked.rgb;
    solution.settings.emplace_back("max-albedo", fmt::format("{}", a.scene.max_albedo));
    const char* const sides[] = {"file", "one", "two"};
    solution.settings.emplace_back("sides", sides[static_cast<int>(a.scene.load.sides)]);
    const SpectrumSum lost = solution.balance.black_backs;
    if (luminance(lost) > most_lost * luminance(solution.balance.emitted))
        console.warn(fmt::format(
            "{:.1f} % of the light met black backs: is the mesh wound inside out? (--sides two)",
            100.0 * luminance(lost) / luminance(solution.balance.emitted)));
    if (a.keep_emitters)
        save_emitter_solution(by_emitters, record, a.output);
    else if (spectral)
        save_spectral_solution(baked, record, a.output);
    else
        save_solution(solution, record, a.output);
    console.end_progress();
    print_summary(solution, a.output);
    return solution.interrupted ? ExitCode::interrupted : ExitCode::done;
}

}  // namespace

void add_bake(CLI::App& program, const Common& common, int& exit_code) {
    auto arguments = std::make_shared<BakeArguments>();
    CLI::App* command =
        program.add_subcommand("bake", "Compute the global illumination of a scene and store it");
    add_options(*command, *arguments);
    command->footer(
        "Examples:\n"
        "  transillum bake room.gltf -o room.vtm\n"
        "  transillum bake room.obj -o room.vtm --repair full --target-error 0.02 --refine 3");
    command->callback([arguments, &common, &exit_code] { exit_code = run(*arguments, common); });
}

}  // namespace transillum::cli
