// `manual` and `completion`: what the program knows of itself, for man and for shells.
#include "cli/command.h"
#include "cli/completion.h"
#include "cli/manual_pages.h"

#include <transillum/base/error.h>
#include <transillum/base/staged_files.h>

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace transillum::cli {

void add_manual(CLI::App& program, const Common&, int& exit_code) {
    auto folder = std::make_shared<std::string>();
    CLI::App* command =
        program.add_subcommand("manual", "Write the manual pages that man(1) shows into a folder");
    command->add_option("FOLDER", *folder, "such as ~/.local/share/man/man1")->required();
    command->footer("transillum manual ~/.local/share/man/man1 && man transillum-bake");
    command->callback([folder, &program, &exit_code] {
        std::error_code failed;
        std::filesystem::create_directories(*folder, failed);
        if (failed) throw IoError(*folder, "cannot be made: " + failed.message());
        for (const ManualPage& page : manual_pages(program)) {
            const std::filesystem::path file = std::filesystem::path(*folder) / page.file;
            write_bytes(page.text, file, file);
        }
        exit_code = ExitCode::done;
    });
}

void add_completion(CLI::App& program, const Common&, int& exit_code) {
    auto shell = std::make_shared<std::string>();
    CLI::App* command =
        program.add_subcommand("completion", "Print what a shell completes command lines with");
    command->add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}).description(""));
    command->footer(
        "transillum completion bash >~/.local/share/bash-completion/completions/transillum\n"
        "transillum completion fish >~/.config/fish/completions/transillum.fish\n"
        "zsh, in ~/.zshrc: source <(transillum completion zsh)");
    command->callback([shell, &program, &exit_code] {
        if (*shell == "fish")
            fmt::print("{}", fish_completion(program));
        else
            fmt::print("{}{}",
                       *shell == "zsh" ? "autoload -U +X bashcompinit && bashcompinit\n" : "",
                       bash_completion(program));
        exit_code = ExitCode::done;
    });
}

}  // namespace transillum::cli
