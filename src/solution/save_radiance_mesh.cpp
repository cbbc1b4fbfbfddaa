#include <transillum/solution/save_radiance_mesh.h>

#include "export/mesh_bytes.h"

#include <transillum/base/error.h>
#include <transillum/base/staged_files.h>

#include <algorithm>
#include <array>

namespace transillum {

namespace {

struct Format {
    const char* extension;
    std::string (*bytes)(const RadianceMesh&, const std::filesystem::path&);
};
constexpr std::array<Format, 3> formats{
    {{".glb", mesh_glb}, {".ply", mesh_ply}, {".vtp", mesh_vtp}}};

const Format& format_of(const std::filesystem::path& path) {
    const auto format = std::ranges::find(formats, path.extension(), &Format::extension);
    if (format == formats.end())
        throw UsageError(path.string() + ": extension '" + path.extension().string() +
                         "'; accepted: .glb, .ply, .vtp");
    return *format;
}

}  // namespace

void require_mesh_extension(const std::filesystem::path& path) {
    (void)format_of(path);
}

void save_radiance_mesh(const RadianceMesh& mesh, const std::filesystem::path& path) {
    const Format& format = format_of(path);
    if (mesh.triangles.empty())
        throw InputError(path.string(), "nothing to write: no side of the solution shines");
    if (!mesh.lightmap_uvs.empty() && format.bytes != mesh_glb)
        throw UsageError(path.string() + ": extension '" + path.extension().string() +
                         "' with a lightmap; accepted: .glb");
    StagedFiles files(path);
    files.write_main(format.bytes(mesh, path));
    files.put_in_place();
}

}  // namespace transillum
