/// A radiance mesh as the bytes of a file, one .cpp a format; what they hold: save_radiance_mesh.h.
#pragma once

#include <transillum/solution/radiance_mesh.h>

#include <filesystem>
#include <string>

namespace transillum {

/// \param file where they are meant to go, for messages
/// \throws InputError, IoError
[[nodiscard]] std::string mesh_glb(const RadianceMesh& mesh, const std::filesystem::path& file);
[[nodiscard]] std::string mesh_ply(const RadianceMesh& mesh, const std::filesystem::path& file);
[[nodiscard]] std::string mesh_vtp(const RadianceMesh& mesh, const std::filesystem::path& file);

}  // namespace transillum
