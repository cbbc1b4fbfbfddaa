/// Cameras that an OBJ states in comments, the format having none of its own.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/scene/scene.h>

#include <string>
#include <string_view>
#include <vector>

namespace transillum {

/// The cameras of lines `# camera NAME eye look-at up fov`: a name without blanks, three vectors of
/// three numbers, the vertical field of view in degrees. A line that begins so and goes on with
/// other than a camera is an ordinary comment; one with numbers no camera can have gets a warning.
[[nodiscard]] std::vector<Camera> read_obj_cameras(const std::string& path, std::string_view text,
                                                   Monitor& monitor);

}  // namespace transillum
