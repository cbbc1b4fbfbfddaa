/// Options of subcommands that look at a surface.
#pragma once

#include <transillum/geometry/surface_mesh.h>
#include <transillum/render/image.h>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace transillum::cli {

struct CameraOptions {
    std::string name;
    std::vector<double> eye, look_at, up;  ///< three numbers, or none
    double vertical_fov = 0.0;             ///< 0: the camera's own
    std::string size = "500x500";
};

struct ImageOptions {
    std::vector<std::string> paths;
    ToneMapping tone;
};

/// Of samples: options of the library, and how they are spoken of.
struct SamplingOptions {
    int& samples;
    int most_samples;
    const char* samples_help;
    std::uint64_t& seed;
    const char* seed_help;
    int& threads;
    const char* group;
};

void add_camera_options(CLI::App& command, CameraOptions& options);
void add_image_options(CLI::App& command, ImageOptions& options);
/// \param what is brightened
void add_tone_options(CLI::App& command, ToneMapping& tone, const std::string& what);
/// --samples, --seed, --threads.
void add_sampling_options(CLI::App& command, const SamplingOptions& options);

/// \throws UsageError for an unknown name, an impossible view, or a name beside a free view.
[[nodiscard]] Camera make_camera(const CameraOptions& options, const std::vector<Camera>& cameras,
                                 const SurfaceMesh& surface);

/// \throws UsageError for another extension than .exr and .png, IoError as require_writable.
void require_writable(const ImageOptions& options);
/// Into every file asked for.
void write_images(const Image& image, const ImageOptions& options);

/// "640x480". \throws UsageError unless both are in [1, 16384].
struct Size {
    int width, height;
};
[[nodiscard]] Size parse_size(const std::string& text);

}  // namespace transillum::cli
