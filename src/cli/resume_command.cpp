#include "cli/bake_output.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/scene_options.h"

#include <transillum/base/error.h>
#include <transillum/solution/load_solution.h>
#include <transillum/solution/resume.h>

#include <fmt/format.h>

#include <memory>

namespace transillum::cli {

namespace {

struct ResumeArguments {
    std::string solution, output;
    ResumeOptions resume;
    double memory = 0.0;
    int threads = 0;
};

void add_options(CLI::App& command, ResumeArguments& a) {
    command.add_option("SOLUTION", a.solution, "what bake or resume wrote: NAME.vtm")->required();
    const char* const output = "Output";
    command.add_option("-o,--output", a.output, "solution to write, NAME.vtm; without, SOLUTION")
        ->group(output);
    add_choice(command, "--keep-sums", a.resume.keep_sums, {{"on", true}, {"off", false}},
               "what another resume needs")
        ->group(output);
    const char* const stopping = "Stopping (whichever comes first)";
    command
        .add_option("--iterations", a.resume.iterations,
                    "directions more; 0: as many again or, with --target-error or --time, until "
                    "that is met")
        ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 31))
        ->capture_default_str()
        ->group(stopping);
    command
        .add_option(
            "--target-error", a.resume.target_error,
            "relative error, as 0.01; 0: none. The estimate is held below it by a sixth or more")
        ->check(within(0.0, 1.0))
        ->capture_default_str()
        ->group(stopping);
    command.add_option("--time", a.resume.seconds, "seconds of transport; 0: no limit")
        ->check(not_negative())
        ->capture_default_str()
        ->group(stopping);
    const char* const method = "Method";
    command
        .add_option("--memory", a.memory,
                    "most GiB that tables may take; 0: nine tenths of the machine's")
        ->check(not_negative())
        ->capture_default_str()
        ->group(method);
    command
        .add_option("--threads", a.threads,
                    "0: as many as the machine has; the result does not depend on it")
        ->capture_default_str()
        ->group(method);
}

int run(ResumeArguments& a, const Common& common) {
    Console console(common);
    if (a.output.empty()) a.output = a.solution;
    if (!a.output.ends_with(".vtm"))
        throw UsageError("--output " + a.output + "; accepted: a name that ends in .vtm");
    a.resume.memory = allowed_memory(a.memory);
    const Workers workers(a.threads);
    Solution solution = load_solution_to_go_on(a.solution);
    require_writable(a.output);
    const std::uint64_t before = solution.iterations;
    RunRecord record = load_run_record(a.solution);
    record.input_hash.clear();  // it was of what is changed here
    record.command_line = common.command_line;
    resume(solution, a.resume, workers, console, &record);
    for (const Decision& d : solution.decisions) console.note(d.what + ": " + d.why);
    console.note(fmt::format("{} iterations more", solution.iterations - before));
    save_solution(solution, record, a.output);
    console.end_progress();
    print_summary(solution, a.output);
    return solution.interrupted ? ExitCode::interrupted : ExitCode::done;
}

}  // namespace

void add_resume(CLI::App& program, const Common& common, int& exit_code) {
    auto arguments = std::make_shared<ResumeArguments>();
    CLI::App* command =
        program.add_subcommand("resume", "Go on with a bake, for more iterations or less error");
    add_options(*command, *arguments);
    command->footer(
        "Example:\n"
        "  transillum resume room.vtm --iterations 1024");
    command->callback([arguments, &common, &exit_code] { exit_code = run(*arguments, common); });
}

}  // namespace transillum::cli
