// `serve`: the web viewer and one solution, to this machine alone.
#include "cli/command.h"
#include "cli/console.h"
#include "cli/web_server.h"

#include <transillum/base/error.h>

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <thread>

namespace transillum::cli {

namespace {

struct ServeArguments {
    std::string file;
    int port = 8080;
};

int run(const ServeArguments& a, const Common& common) {
    Console console(common);
    WebServer server(a.file, a.port);
    fmt::print("{}\n", server.url());
    std::fflush(stdout);
    console.note("open it in a browser; Ctrl-C ends this");
    while (!console.stop_requested() && server.is_running())
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return ExitCode::done;
}

}  // namespace

void add_serve(CLI::App& program, const Common& common, int& exit_code) {
    auto a = std::make_shared<ServeArguments>();
    CLI::App* command =
        program.add_subcommand("serve", "Show a solution in a browser on this machine");
    command
        ->add_option("SOLUTION", a->file,
                     "what bake wrote, NAME.vtm, or export: .glb, .ply or .vtp")
        ->required();
    command->add_option("--port", a->port, "of 127.0.0.1; 0: any that is free")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    command->footer(
        "Example:\n"
        "  transillum serve room.vtm");
    command->callback([a, &common, &exit_code] { exit_code = run(*a, common); });
}

}  // namespace transillum::cli
