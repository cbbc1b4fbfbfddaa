/// Options of subcommands that read a scene.
#pragma once

#include "cli/lighting_options.h"

#include <transillum/base/monitor.h>
#include <transillum/scene/load_scene.h>
#include <transillum/scene/scene.h>

#include <CLI/CLI.hpp>

#include <map>
#include <string>

namespace transillum::cli {

struct SceneOptions {
    std::string path;
    LoadOptions load;
    float max_albedo = 0.99f;
    LightingOptions lighting;
};

/// SCENE
void add_scene_argument(CLI::App& command, std::string& path);
/// --sides and --drop-transparent
void add_load_options(CLI::App& command, LoadOptions& options);
/// All of them.
void add_scene_options(CLI::App& command, SceneOptions& options);

/// Loads, limits the albedo and adds the lighting.
[[nodiscard]] Scene read_scene(const SceneOptions& options, Monitor& monitor);

/// Refuses at once what could only be refused after hours of work.
/// \throws IoError when the folder of `path` does not exist or cannot be written to.
void require_writable(const std::string& path);

/// A number in [least, most]. CLI11's own checks let NaN pass.
[[nodiscard]] CLI::Validator within(double least, double most);
/// A finite number, not negative.
[[nodiscard]] CLI::Validator not_negative();

/// An option that takes one of several words.
template <class Enum>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Enum& value,
                        const std::map<std::string, Enum>& words, const std::string& help) {
    std::string accepted;
    std::string now;
    for (const auto& [word, meaning] : words) {
        accepted += (accepted.empty() ? "" : "|") + word;
        if (meaning == value) now = word;
    }
    return command
        .add_option_function<std::string>(
            name, [&value, words](const std::string& word) { value = words.at(word); }, help)
        ->check(CLI::IsMember(words).description(""))
        ->type_name(accepted)
        ->default_str(now);
}

}  // namespace transillum::cli
