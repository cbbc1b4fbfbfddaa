/// What a shell completes a command line with, made of what --help says.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace transillum::cli {

/// Subcommands, options, and the words that an option accepts; else files. For bash; zsh reads the
/// same after `autoload bashcompinit && bashcompinit`.
[[nodiscard]] std::string bash_completion(const CLI::App& program);
[[nodiscard]] std::string fish_completion(const CLI::App& program);

}  // namespace transillum::cli
