/// Manual pages of the program and its subcommands (man(7)), made of what --help says.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace transillum::cli {

struct ManualPage {
    std::string file;  ///< "transillum-bake.1"
    std::string text;
};

/// The program's, then one a subcommand.
[[nodiscard]] std::vector<ManualPage> manual_pages(const CLI::App& program);

}  // namespace transillum::cli
