/// Subcommands: each adds itself to the program and runs when it was chosen.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace transillum::cli {

enum ExitCode {
    done = 0,
    comparison_failed = 1,
    usage = 2,
    bad_input = 3,
    io_failed = 4,
    interrupted = 130
};

enum class ProgressStyle {
    automatic,  ///< a bar on a terminal, else plain
    bar,
    plain,  ///< a line every few seconds
    json,   ///< every second; messages, too: an object a line
    none
};

/// Options every subcommand shares.
struct Common {
    std::string command_line;  ///< as given, for the record
    bool quiet = false;        ///< no progress and no notes
    bool verbose = false;      ///< how long phases took
    ProgressStyle progress = ProgressStyle::automatic;
};

// Each sets `exit_code` when its subcommand was run.
void add_bake(CLI::App& program, const Common& common, int& exit_code);
void add_relight(CLI::App& program, const Common& common, int& exit_code);
void add_resume(CLI::App& program, const Common& common, int& exit_code);
void add_walk(CLI::App& program, const Common& common, int& exit_code);
void add_render(CLI::App& program, const Common& common, int& exit_code);
void add_info(CLI::App& program, const Common& common, int& exit_code);
void add_repair(CLI::App& program, const Common& common, int& exit_code);
void add_check(CLI::App& program, const Common& common, int& exit_code);
void add_export(CLI::App& program, const Common& common, int& exit_code);
void add_compare(CLI::App& program, const Common& common, int& exit_code);
void add_reference(CLI::App& program, const Common& common, int& exit_code);
void add_subdivide(CLI::App& program, const Common& common, int& exit_code);
void add_serve(CLI::App& program, const Common& common, int& exit_code);
void add_manual(CLI::App& program, const Common& common, int& exit_code);
void add_completion(CLI::App& program, const Common& common, int& exit_code);

}  // namespace transillum::cli
