#include "cli/camera_options.h"

#include "cli/scene_options.h"

#include <transillum/base/error.h>
#include <transillum/render/render_solution.h>

#include <glm/geometric.hpp>

#include <charconv>

namespace transillum::cli {

namespace {

glm::dvec3 point(const std::vector<double>& v) {
    return {v[0], v[1], v[2]};
}

double checked_fov(double degrees) {
    if (degrees > 0.0 && degrees < 180.0) return degrees;
    throw UsageError("--fov " + std::to_string(degrees) + "; accepted: between 0 and 180 degrees");
}

}  // namespace

void add_camera_options(CLI::App& command, CameraOptions& options) {
    const auto vector = [&](const char* name, std::vector<double>& value, const char* help) {
        return command.add_option(name, value, help)
            ->expected(3)
            ->delimiter(',')
            ->check(within(-1e30, 1e30).description(""))
            ->type_name("X,Y,Z")
            ->group("Camera");
    };
    command
        .add_option("--camera", options.name, "a camera of the scene, by name (default: the first)")
        ->group("Camera");
    vector("--eye", options.eye, "where the eye is; with --look-at instead of --camera");
    vector("--look-at", options.look_at, "a point in the middle of the picture");
    vector("--up", options.up, "upwards in the picture (default: 0,1,0)");
    command
        .add_option("--fov", options.vertical_fov,
                    "vertical field of view [degrees] (default: the camera's own, else 45)")
        ->group("Camera");
    command.add_option("--size", options.size, "pixels")
        ->type_name("WxH")
        ->capture_default_str()
        ->group("Camera");
}

void add_image_options(CLI::App& command, ImageOptions& options) {
    command
        .add_option("-o,--output", options.paths,
                    "picture: .exr linear, .png tone-mapped; may be given more than once")
        ->allow_extra_args(false)
        ->required()
        ->group("Output");
    add_tone_options(command, options.tone, "the PNG");
}

void add_tone_options(CLI::App& command, ToneMapping& tone, const std::string& what) {
    command.add_option("--exposure", tone.exposure, "brighten " + what + " by so many stops")
        ->check(within(-100.0, 100.0))
        ->capture_default_str()
        ->group("Output");
    command
        .add_flag_callback(
            "--no-auto-exposure", [&tone] { tone.automatic = false; },
            "a radiance of 1 is white (default: middle grey is the median)")
        ->group("Output");
}

void add_sampling_options(CLI::App& command, const SamplingOptions& options) {
    command.add_option("--samples", options.samples, options.samples_help)
        ->check(CLI::Range(1, options.most_samples))
        ->capture_default_str()
        ->group(options.group);
    command.add_option("--seed", options.seed, options.seed_help)
        ->capture_default_str()
        ->group(options.group);
    command.add_option("--threads", options.threads, "0: as many as the machine has")
        ->capture_default_str()
        ->group(options.group);
}

void write_images(const Image& image, const ImageOptions& options) {
    for (const std::string& path : options.paths) write_image(image, path, options.tone);
}

void require_writable(const ImageOptions& options) {
    for (const std::string& path : options.paths) {
        if (!path.ends_with(".exr") && !path.ends_with(".png"))
            throw UsageError("--output " + path + "; accepted: a name that ends in .exr or .png");
        require_writable(path);
    }
}

Camera make_camera(const CameraOptions& options, const std::vector<Camera>& cameras,
                   const SurfaceMesh& surface) {
    if (options.eye.empty() && options.look_at.empty()) {
        if (!options.up.empty()) throw UsageError("--up: needs --eye and --look-at");
        Camera camera = choose_camera(cameras, surface, options.name);
        if (options.vertical_fov != 0.0) camera.vertical_fov = checked_fov(options.vertical_fov);
        return camera;
    }
    if (!options.name.empty())
        throw UsageError("--camera " + options.name + ": not together with --eye and --look-at");
    if (options.eye.empty() || options.look_at.empty())
        throw UsageError("--eye and --look-at: each needs the other");
    Camera camera;
    camera.eye = point(options.eye);
    camera.look_at = point(options.look_at);
    if (!options.up.empty()) camera.up = point(options.up);
    if (options.vertical_fov != 0.0) camera.vertical_fov = checked_fov(options.vertical_fov);
    if (glm::length(glm::cross(camera.look_at - camera.eye, camera.up)) == 0.0)
        throw UsageError(
            "--up: parallel to the view from --eye to --look-at, or these are one point; accepted: "
            "another direction");
    return camera;
}

Size parse_size(const std::string& text) {
    Size size{};
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        const auto height = std::from_chars(width.ptr + 1, end, size.height);
        if (height.ec == std::errc() && height.ptr == end && size.width >= 1 &&
            size.width <= 16384 && size.height >= 1 && size.height <= 16384)
            return size;
    }
    throw UsageError("--size " + text + "; accepted: WIDTHxHEIGHT, each 1 to 16384");
}

}  // namespace transillum::cli
