// Walk-through (paper §5): frames along a path. The finite elements stay as they are, direct light
// is reflected anew towards each eye, and the Monte-Carlo component is sampled for each frame.
#include "cli/command.h"
#include "cli/console.h"
#include "cli/scene_options.h"
#include "cli/shading_options.h"

#include <transillum/base/error.h>
#include <transillum/render/camera_path.h>
#include <transillum/render/render_bands.h>
#include <transillum/solution/load_solution.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

namespace transillum::cli {

namespace {

constexpr double most_frames = 1e6;

struct WalkArguments {
    std::string solution, path, folder;
    std::string size = "500x500", format = "png";
    double frames_a_second = 25.0;
    double exposure = 0.0;
    ShadingOptions shading;
};

/// Says nothing of a frame's own progress, but passes on that the user wants to stop.
class FrameMonitor : public Monitor {
public:
    explicit FrameMonitor(const Monitor& whole) : whole_(whole) {}
    [[nodiscard]] bool stop_requested() const override { return whole_.stop_requested(); }

private:
    const Monitor& whole_;
};

std::uint64_t frame_count(const CameraPath& path, double frames_a_second) {
    const double seconds = path.back().time - path.front().time;
    const double frames = std::floor(seconds * frames_a_second + 1e-9) + 1.0;
    if (frames > most_frames)
        throw UsageError(fmt::format("{:.0f} frames ({} s at --fps {}); accepted: at most {:.0f}",
                                     frames, seconds, frames_a_second, most_frames));
    return static_cast<std::uint64_t>(frames);
}

int run(const WalkArguments& a, const Common& common) {
    Console console(common);
    RenderOptions render = make_render_options(a.shading, parse_size(a.size));
    const CameraPath path = read_camera_path(a.path);
    const std::uint64_t frames = frame_count(path, a.frames_a_second);
    std::error_code failed;
    std::filesystem::create_directories(a.folder, failed);
    if (failed) throw IoError(a.folder, "cannot be made: " + failed.message());
    require_writable(a.folder + "/frame");
    const Workers workers(a.shading.threads);
    SpectralSolution solution = load_spectral_solution(a.solution);
    // Carried from frame to frame, it needs few bundles for each, and does not flicker.
    if (render.monte_carlo == MonteCarloShading::automatic && !solution.rgb.glossy.empty())
        render.monte_carlo = MonteCarloShading::subpatch;
    BandRenderer renderer(std::move(solution), render, workers, console);
    FrameMonitor silent(console);
    ToneMapping tone{a.exposure, true};
    for (std::uint64_t i = 0; i < frames; ++i) {
        const double time = path.front().time + static_cast<double>(i) / a.frames_a_second;
        const Image image = renderer.render(camera_at(path, time), workers, silent);
        if (console.stop_requested()) return ExitCode::interrupted;
        // One exposure for all frames, or they would flicker.
        if (tone.automatic) tone = {a.exposure + automatic_exposure(image), false};
        write_image(image, fmt::format("{}/frame-{:05}.{}", a.folder, i, a.format), tone);
        console.progress({"walk", i + 1, frames});
    }
    console.end_progress();
    fmt::print("{}: {} frames, {} a second\n", a.folder, frames, a.frames_a_second);
    return ExitCode::done;
}

}  // namespace

void add_walk(CLI::App& program, const Common& common, int& exit_code) {
    auto a = std::make_shared<WalkArguments>();
    a->shading.render.direct = DirectShading::stored;
    a->shading.render.iterations = 8;
    CLI::App* command = program.add_subcommand("walk", "Show a solution along a camera path");
    command->add_option("SOLUTION", a->solution, "what bake wrote: NAME.vtm")->required();
    command
        ->add_option("--path", a->path,
                     "key frames, one a line: time eye look-at up fov (seconds, degrees)")
        ->required()
        ->group("Camera");
    command->add_option("--fps", a->frames_a_second, "frames a second of the path")
        ->check(within(1e-3, 1e4))
        ->capture_default_str()
        ->group("Camera");
    command->add_option("--size", a->size, "pixels")
        ->type_name("WxH")
        ->capture_default_str()
        ->group("Camera");
    command->add_option("-o,--output", a->folder, "folder for frame-00000.png and so on")
        ->required()
        ->group("Output");
    command->add_option("--format", a->format, "png tone-mapped, exr linear")
        ->check(CLI::IsMember({"png", "exr"}))
        ->capture_default_str()
        ->group("Output");
    command
        ->add_option("--exposure", a->exposure,
                     "brighten PNGs by so many stops, from the first frame's own exposure")
        ->check(within(-100.0, 100.0))
        ->capture_default_str()
        ->group("Output");
    add_shading_options(*command, a->shading, "subpatch");
    command->footer(
        "Example:\n"
        "  transillum walk room.vtm --path tour.path -o frames");
    command->callback([a, &common, &exit_code] { exit_code = run(*a, common); });
}

}  // namespace transillum::cli
