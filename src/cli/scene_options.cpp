#include "cli/scene_options.h"

#include <transillum/base/error.h>
#include <transillum/scene/limit_albedo.h>

#include <fmt/format.h>

#include <unistd.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

namespace transillum::cli {

void add_scene_argument(CLI::App& command, std::string& path) {
    command.add_option("SCENE", path, "scene: .gltf .glb .obj .ply .stl .off")->required();
}

void add_load_options(CLI::App& command, LoadOptions& options) {
    add_choice(command, "--sides", options.sides,
               {{"file", Sides::file}, {"one", Sides::one}, {"two", Sides::two}},
               "which sides of a surface reflect and emit")
        ->group("Scene");
    command
        .add_flag("--drop-transparent", options.drop_transparent,
                  "leave out transparent surfaces (else they are opaque)")
        ->group("Scene");
}

void add_scene_options(CLI::App& command, SceneOptions& options) {
    add_scene_argument(command, options.path);
    add_load_options(command, options.load);
    command
        .add_option("--max-albedo", options.max_albedo, "albedos above it are reduced, per channel")
        ->check(within(0.0, 1.0))
        ->capture_default_str()
        ->group("Scene");
    add_lighting_options(command, options.lighting);
}

Scene read_scene(const SceneOptions& options, Monitor& monitor) {
    const Lighting given = make_lighting(options.lighting, monitor);
    Scene scene = load_scene(options.path, options.load, monitor);
    limit_albedo(scene, options.max_albedo, monitor);
    auto& lights = scene.lighting.lights;
    lights.insert(lights.end(), given.lights.begin(), given.lights.end());
    if (given.environment.shines()) scene.lighting.environment = given.environment;
    hang_photometry(options.lighting, scene, monitor);
    return scene;
}

CLI::Validator within(double least, double most) {
    const std::string accepted = fmt::format("in [{:g}, {:g}]", least, most);
    const auto check = [=](const std::string& word) {
        double value = 0.0;
        const bool good = CLI::detail::lexical_cast(word, value) && value >= least && value <= most;
        return good ? std::string() : word + " is not " + accepted;
    };
    return CLI::Validator(check, accepted);
}

CLI::Validator not_negative() {
    return within(0.0, std::numeric_limits<double>::max()).description("not negative");
}

void require_writable(const std::string& path) {
    const std::filesystem::path file(path);
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!std::filesystem::is_directory(folder))
        throw IoError(path, "its folder does not exist; accepted: an existing one");
    if (std::filesystem::is_directory(file))
        throw IoError(path, "is a folder; accepted: a file's name");
    std::string trial = (folder / ".transillum.XXXXXX").string();
    if (!mkdtemp(trial.data()))
        throw IoError(path, std::string("cannot write to its folder: ") + std::strerror(errno));
    rmdir(trial.c_str());
}

}  // namespace transillum::cli
