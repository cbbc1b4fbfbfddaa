// The program: parses, runs one subcommand, and alone prints errors and decides the exit code.
#include "cli/command.h"
#include "cli/log_file.h"
#include "cli/progress_meter.h"
#include "cli/scene_options.h"

#include <transillum/base/error.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace {

using namespace transillum::cli;

std::string join(int argc, char** argv) {
    std::string line;
    for (int i = 0; i < argc; ++i) line += (i ? " " : "") + std::string(argv[i]);
    return line;
}

int fail(const Common& common, const char* what, int exit_code) {
    log("error", what);
    if (common.progress == ProgressStyle::json)
        std::fprintf(stderr, "%s\n", json_message("error", what).c_str());
    else
        std::fprintf(stderr, "transillum: %s\n", what);
    return exit_code;
}

void add_common_options(CLI::App& program, Common& common) {
    const char* const group = "Messages (of every subcommand)";
    auto* const quiet = program
                            .add_flag("-q,--quiet", common.quiet,
                                      "no progress and no notes; of --progress json, no notes")
                            ->group(group);
    program.add_flag("-v,--verbose", common.verbose, "how long every phase took")
        ->excludes(quiet)
        ->group(group);
    add_choice(program, "--progress", common.progress,
               {{"auto", ProgressStyle::automatic},
                {"bar", ProgressStyle::bar},
                {"plain", ProgressStyle::plain},
                {"json", ProgressStyle::json},
                {"none", ProgressStyle::none}},
               "on stderr; auto: a bar on a terminal, else a plain line every 5 s; json: an object "
               "a line, messages, too")
        ->group(group);
    program
        .add_option_function<std::string>(
            "--log-file",
            [&common](const std::string& path) {
                open_log(path);
                log("command", common.command_line);
            },
            "append all that is told here, with the time, also of --quiet")
        ->group(group);
}

/// What is wrong with the command line. An unknown option says more than the argument that it
/// displaced.
std::string describe(const CLI::App& program, const CLI::ParseError& error) {
    for (const std::string& word : program.remaining(true))
        if (word.starts_with('-')) return "unknown option " + word + "; accepted: those of --help";
    std::string line = error.what();
    std::ranges::replace(line, '\n', ' ');
    return line + "; --help lists what is accepted";
}

int parse_and_run(int argc, char** argv, Common& common) {
    CLI::App program(
        "transillum: bakes view-independent global illumination into VTK meshes and looks at them "
        "again",
        "transillum");
    program.set_version_flag("--version", "transillum " TRANSILLUM_VERSION);
    program.require_subcommand(1);
    program.fallthrough();
    program.footer(
        "Exit codes: 0 done, 1 comparison failed, 2 usage, 3 bad input, 4 input/output, 130 "
        "interrupted.\n"
        "Data goes to stdout, progress and messages to stderr.");
    common.command_line = join(argc, argv);
    add_common_options(program, common);
    int exit_code = ExitCode::done;
    add_bake(program, common, exit_code);
    add_relight(program, common, exit_code);
    add_resume(program, common, exit_code);
    add_render(program, common, exit_code);
    add_walk(program, common, exit_code);
    add_export(program, common, exit_code);
    add_serve(program, common, exit_code);
    add_info(program, common, exit_code);
    add_repair(program, common, exit_code);
    add_check(program, common, exit_code);
    add_compare(program, common, exit_code);
    add_reference(program, common, exit_code);
    add_subdivide(program, common, exit_code);
    add_manual(program, common, exit_code);
    add_completion(program, common, exit_code);
    for (CLI::App* command : program.get_subcommands({}))
        command->footer(command->get_footer() +
                        "\nMessages, as of every subcommand: --quiet, --verbose, --progress, "
                        "--log-file; see transillum --help");
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& e) {
        return program.exit(e);
    } catch (const CLI::ParseError& e) {
        return fail(common, describe(program, e).c_str(), ExitCode::usage);
    }
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    Common common;
    try {
        return parse_and_run(argc, argv, common);
    } catch (const transillum::UsageError& e) {
        return fail(common, e.what(), ExitCode::usage);
    } catch (const transillum::InputError& e) {
        return fail(common, e.what(), ExitCode::bad_input);
    } catch (const transillum::IoError& e) {
        return fail(common, e.what(), ExitCode::io_failed);
    } catch (const std::bad_alloc&) {
        return fail(common, "out of memory; fewer leaves or light samples need less",
                    ExitCode::io_failed);
    } catch (const std::exception& e) {
        return fail(common, e.what(), ExitCode::bad_input);
    }
}
