/// A camera that moves (paper §5, walk-through).
#pragma once

#include <transillum/scene/scene.h>

#include <filesystem>
#include <vector>

namespace transillum {

struct KeyFrame {
    double time = 0.0;  ///< [s]
    Camera camera;
};

/// Key frames in order of time, at least one; between them everything is linear.
using CameraPath = std::vector<KeyFrame>;

/// Reads a text with a key frame a line: `time eye look-at up fov`, eleven numbers; `#` begins a
/// comment. \throws IoError; InputError naming file and line where one has other than eleven
/// finite numbers, a time not after the one before, a field of view outside (0, 180), or an eye and
/// directions that span no frame; or where there is no key frame.
[[nodiscard]] CameraPath read_camera_path(const std::filesystem::path& path);

/// Before the first and after the last key frame the camera stands still.
[[nodiscard]] Camera camera_at(const CameraPath& path, double time);

}  // namespace transillum
