// transillum-view: walks through a solution in a window.
#include "require_display.h"
#include "solution_view.h"
#include "walk_style.h"

#include <transillum/base/error.h>
#include <transillum/render/render_solution.h>
#include <transillum/solution/load_solution.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <vtkAutoInit.h>
#include <vtkRenderWindowInteractor.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)
VTK_MODULE_INIT(vtkInteractionStyle)

namespace {

using namespace transillum;
using namespace transillum::viewer;

enum ExitCode { done = 0, usage = 2, bad_input = 3, io_failed = 4 };

struct Arguments {
    std::string solution, camera, screenshot;
    int quantity = 1, width = 1024, height = 768, threads = 0;
    double exposure = 0.0;
    bool automatic = true, iterate = true;
};

void add_options(CLI::App& program, Arguments& a) {
    program.add_option("SOLUTION", a.solution, "what bake wrote: NAME.vtm")->required();
    program.add_option("--camera", a.camera, "of the solution, by name (default: the first)");
    program.add_option("--quantity", a.quantity, "shown first, by its key: 1 is total radiance")
        ->check(CLI::Range(1, 10))
        ->capture_default_str();
    program.add_option("--exposure", a.exposure, "stops beside automatic exposure")
        ->check(CLI::Range(-30.0, 30.0))
        ->capture_default_str();
    program.add_flag_callback(
        "--no-auto-exposure", [&a] { a.automatic = false; },
        "a radiance of 1 is white (default: middle grey is the median)");
    program.add_option("--width", a.width, "of the window [pixels]")
        ->check(CLI::Range(64, 8192))
        ->capture_default_str();
    program.add_option("--height", a.height)->check(CLI::Range(64, 8192))->capture_default_str();
    program.add_option("--screenshot", a.screenshot,
                       "write what the window shows to this .png, without title and help, and end");
    program.add_flag("--no-iteration{false}", a.iterate,
                     "show what is stored alone, also where the view stands still (key i)");
    program.add_option("--threads", a.threads, "0: as many as the machine has")
        ->capture_default_str();
    program.footer(std::string("Keys:\n") + key_help +
                   "\nExample:\n  transillum-view room.vtm --camera front");
}

int run(const Arguments& a) {
    require_display();
    const Workers workers(a.threads);
    SpectralSolution solution = load_spectral_solution(a.solution);
    const Camera camera = choose_camera(solution.rgb.cameras, solution.rgb.surface, a.camera);
    const std::filesystem::path path(a.solution);
    SolutionView view(std::move(solution), path.filename().string(), workers);
    view.window().SetSize(a.width, a.height);
    view.look(camera);
    if (a.quantity > static_cast<int>(view.quantities().size()))
        throw UsageError(
            fmt::format("--quantity {}; accepted: 1 to {}", a.quantity, view.quantities().size()));
    vtkNew<vtkRenderWindowInteractor> interactor;
    interactor->SetRenderWindow(&view.window());
    vtkNew<WalkStyle> style;
    style->set_view(view, path.parent_path() / path.stem());
    interactor->SetInteractorStyle(style);
    view.expose((a.automatic ? view.stops() : 0.0) + a.exposure);
    view.show(static_cast<std::size_t>(a.quantity - 1));
    if (!a.screenshot.empty()) {
        view.toggle_text();
        view.save_picture(a.screenshot);
        return ExitCode::done;
    }
    view.iterate_when_still(a.iterate);
    interactor->Initialize();
    constexpr unsigned long look_milliseconds = 100;
    interactor->CreateRepeatingTimer(look_milliseconds);
    interactor->Start();
    return ExitCode::done;
}

int fail(const char* what, int exit_code) {
    std::fprintf(stderr, "transillum-view: %s\n", what);
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments a;
    CLI::App program("Walk through a solution of transillum", "transillum-view");
    program.set_version_flag("--version", "transillum-view " TRANSILLUM_VERSION);
    add_options(program, a);
    try {
        program.parse(argc, argv);
        return run(a);
    } catch (const CLI::Success& e) {
        return program.exit(e);
    } catch (const CLI::ParseError& e) {
        return fail(e.what(), ExitCode::usage);
    } catch (const UsageError& e) {
        return fail(e.what(), ExitCode::usage);
    } catch (const InputError& e) {
        return fail(e.what(), ExitCode::bad_input);
    } catch (const IoError& e) {
        return fail(e.what(), ExitCode::io_failed);
    } catch (const std::exception& e) {
        return fail(e.what(), ExitCode::bad_input);
    }
}
