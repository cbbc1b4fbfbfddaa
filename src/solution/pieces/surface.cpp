#include "members.h"
#include "pieces.h"

#include "solution/vtk_arrays.h"

#include <transillum/base/error.h>
#include <transillum/geometry/root_trees.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>

namespace transillum {

namespace {

/// Calls `each(array name, member)`: the one list that writing and reading share.
template <class Each>
void for_material_members(Each each) {
    each("MaterialName", &Material::name);
    each("MaterialDiffuse", &Material::diffuse);
    each("MaterialSpecular", &Material::specular);
    each("MaterialLobe", &Material::lobe);
    each("MaterialShininess", &Material::shininess);
    each("MaterialRoughness", &Material::roughness);
    each("MaterialEmission", &Material::emission);
    each("MaterialBackReflects", &Material::back_reflects);
    each("MaterialBackEmits", &Material::back_emits);
    each("MaterialOpacity", &Material::opacity);
}

template <class Each>
void for_camera_members(Each each) {
    each("CameraName", &Camera::name);
    each("CameraEye", &Camera::eye);
    each("CameraLookAt", &Camera::look_at);
    each("CameraUp", &Camera::up);
    each("CameraVerticalFov", &Camera::vertical_fov);
}

template <class Each>
void for_triangle_members(Each each) {
    each("Fans", &RootTriangle::fans);
    each("Material", &RootTriangle::material);
    each("SourceObject", &RootTriangle::object);
    each("SourceFace", &RootTriangle::source_face);
}

/// Indices of a material's textures.
using TextureIndices = std::array<std::int32_t, 4>;

void add_material_textures(const SurfaceMesh& mesh, vtkFieldData& fields) {
    const std::vector<std::uint32_t> used = used_textures(mesh);
    const auto stored = [&](std::int32_t texture) {
        if (texture < 0) return texture;
        return static_cast<std::int32_t>(
            std::ranges::lower_bound(used, static_cast<std::uint32_t>(texture)) - used.begin());
    };
    add_array(fields, "MaterialTextures", mesh.materials.size(), [&](std::size_t i) {
        const MaterialTextures& t = mesh.materials[i].textures;
        return TextureIndices{stored(t.diffuse), stored(t.specular), stored(t.roughness),
                              stored(t.emission)};
    });
    add_value(fields, "TextureCount", static_cast<std::uint32_t>(used.size()));
}

void read_material_textures(const ArrayReader& reader, const Path& file, SurfaceMesh& mesh) {
    const auto indices = reader.read<TextureIndices>("MaterialTextures", mesh.materials.size());
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const auto& [diffuse, specular, roughness, emission] = indices[i];
        mesh.materials[i].textures = {diffuse, specular, roughness, emission};
    }
    const auto count = reader.read_value<std::uint32_t>("TextureCount");
    if (count > 4 * mesh.materials.size()) {
        throw InputError(file.string(), "array 'TextureCount': " + std::to_string(count) +
                                            " textures of " +
                                            std::to_string(mesh.materials.size()) + " materials");
    }
    mesh.textures.resize(count);
}

using CornerUvs = std::array<float, 6>;

void add_uvs(const SurfaceMesh& mesh, vtkFieldData& cells) {
    if (mesh.uvs.empty()) return;
    add_array(cells, "UVs", mesh.triangles.size(), [&](std::size_t i) {
        CornerUvs corners{};
        for (std::size_t k = 0; k < 6; ++k) {
            corners[k] = mesh.uvs[3 * i + k / 2][static_cast<int>(k % 2)];
        }
        return corners;
    });
}

void read_uvs(const ArrayReader& reader, SurfaceMesh& mesh) {
    if (!reader.has("UVs")) return;
    for (const CornerUvs& c : reader.read<CornerUvs>("UVs", mesh.triangles.size())) {
        mesh.uvs.insert(mesh.uvs.end(), {{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}});
    }
}

void add_shot_sides(const std::vector<std::uint8_t>& shot_sides, vtkFieldData& cells) {
    const std::size_t roots = shot_sides.size() / 2;
    if (roots == 0) return;
    add_array(cells, "FirstShotFront", roots, [&](std::size_t i) { return shot_sides[2 * i]; });
    add_array(cells, "FirstShotBack", roots, [&](std::size_t i) { return shot_sides[2 * i + 1]; });
}

void read_shot_sides(const ArrayReader& reader, std::size_t roots,
                     std::vector<std::uint8_t>& shot_sides) {
    if (!reader.has("FirstShotFront")) return;
    const auto fronts = reader.read_flags("FirstShotFront", roots);
    const auto backs = reader.read_flags("FirstShotBack", roots);
    shot_sides.clear();
    for (std::size_t i = 0; i < roots; ++i) {
        shot_sides.insert(shot_sides.end(), {fronts[i], backs[i]});
    }
}

/// Bin level of either side; -1 without a lobe.
void add_bin_levels(const Solution& solution, vtkFieldData& cells) {
    if (solution.glossy.empty()) return;
    for (const bool back : {false, true})
        add_array(cells, back ? "BinLevelBack" : "BinLevelFront", solution.surface.triangles.size(),
                  [&](std::size_t i) {
                      const GlossySide* const side =
                          solution.glossy.find(static_cast<std::uint32_t>(i), back);
                      return side ? side->bin_level : -1;
                  });
}

void read_bin_levels(const ArrayReader& reader, const Path& file, Solution& solution) {
    const std::size_t roots = solution.surface.triangles.size();
    std::vector<std::int8_t> levels(2 * roots, -1);
    if (reader.has("BinLevelFront"))
        for (const std::size_t back : {0u, 1u}) {
            const char* const name = back ? "BinLevelBack" : "BinLevelFront";
            const auto of_roots = reader.read<std::int32_t>(name, roots);
            for (std::size_t i = 0; i < roots; ++i) {
                if (of_roots[i] < -1 || of_roots[i] > max_bin_level)
                    throw InputError(file.string(), std::string("array '") + name +
                                                        "': " + std::to_string(of_roots[i]) +
                                                        " is outside [-1, " +
                                                        std::to_string(max_bin_level) + "]");
                levels[2 * i + back] = static_cast<std::int8_t>(of_roots[i]);
            }
        }
    const SurfaceMesh& mesh = solution.surface;
    for (std::size_t i = 0; i < roots; ++i)
        if (mesh.triangles[i].material >= mesh.materials.size())
            throw InputError(file.string(), "root " + std::to_string(i) + " material: index " +
                                                std::to_string(mesh.triangles[i].material) +
                                                " of " + std::to_string(mesh.materials.size()));
    solution.glossy = lay_out_glossy_sides(solution.surface, solution.patches, levels);
}

PolyData triangles_of(const SurfaceMesh& mesh) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const glm::dvec3& p : mesh.positions) points->InsertNextPoint(p.x, p.y, p.z);
    vtkNew<vtkCellArray> triangles;
    for (const RootTriangle& triangle : mesh.triangles) {
        const auto& v = triangle.vertices;
        const std::array<vtkIdType, 3> corners{v[0], v[1], v[2]};
        triangles->InsertNextCell(3, corners.data());
    }
    auto piece = PolyData::New();
    piece->SetPoints(points);
    piece->SetPolys(triangles);
    return piece;
}

void read_triangles(vtkPolyData& piece, const Path& file, SurfaceMesh& mesh) {
    for (vtkIdType i = 0; i < piece.GetNumberOfPoints(); ++i) {
        const double* p = piece.GetPoint(i);
        mesh.positions.emplace_back(p[0], p[1], p[2]);
    }
    vtkCellArray& cells = *piece.GetPolys();
    mesh.triangles.resize(static_cast<std::size_t>(cells.GetNumberOfCells()));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        vtkIdType size = 0;
        const vtkIdType* corners = nullptr;
        cells.GetCellAtId(static_cast<vtkIdType>(i), size, corners);
        if (size != 3) {
            throw InputError(file.string(), "cell " + std::to_string(i) + " has " +
                                                std::to_string(size) + " corners, expected 3");
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (corners[k] < 0 || corners[k] >= piece.GetNumberOfPoints()) {
                throw InputError(file.string(), "cell " + std::to_string(i) + ": no point " +
                                                    std::to_string(corners[k]));
            }
            mesh.triangles[i].vertices[k] = static_cast<std::uint32_t>(corners[k]);
        }
    }
}

void add_trees(const PatchHierarchy& patches, vtkFieldData& cells, vtkFieldData& fields) {
    const RootTrees trees = trees_of(patches);
    const auto add = [](vtkFieldData& to, const char* name, const auto& values) {
        add_array(to, name, values.size(), [&](std::size_t i) { return values[i]; });
    };
    add(cells, "Level", trees.levels);
    add(cells, "LeafCount", trees.leaf_counts);
    add(fields, "LeafLevel", trees.leaf_levels);
}

void read_trees(const ArrayReader& cells, const ArrayReader& fields, const Path& file,
                std::size_t roots, PatchHierarchy& patches) try {
    patches = subdivide_to_trees({cells.read<std::int32_t>("Level", roots),
                                  cells.read<std::uint32_t>("LeafCount", roots),
                                  fields.read<std::uint8_t>("LeafLevel")});
} catch (const UsageError& error) {
    throw InputError(file.string(), error.what());
}

}  // namespace

PolyData surface_piece(const Solution& solution) {
    const SurfaceMesh& mesh = solution.surface;
    PolyData piece = triangles_of(mesh);
    vtkCellData& cells = *piece->GetCellData();
    for_triangle_members(
        [&](const char* name, auto member) { add_member(cells, name, mesh.triangles, member); });
    add_array(cells, "Normals", mesh.triangles.size(), [&](std::size_t i) {
        return Spectrum(normal_of(mesh, static_cast<std::uint32_t>(i)));
    });
    cells.SetActiveNormals("Normals");
    add_uvs(mesh, cells);
    add_shot_sides(solution.direct.shot_sides, cells);
    add_bin_levels(solution, cells);

    vtkFieldData& fields = *piece->GetFieldData();
    add_trees(solution.patches, cells, fields);
    for_material_members(
        [&](const char* name, auto member) { add_member(fields, name, mesh.materials, member); });
    add_material_textures(mesh, fields);
    for_camera_members(
        [&](const char* name, auto member) { add_member(fields, name, solution.cameras, member); });
    add_strings(fields, "ObjectName", mesh.objects);
    add_value(fields, "FanCount", mesh.fan_count);
    add_value(fields, "GridExponent", std::int32_t{mesh.grid.exponent});
    add_value(fields, "GridLargestMove", mesh.grid.largest_move);
    return piece;
}

void read_surface_piece(vtkPolyData& piece, const Path& file, Solution& solution) {
    SurfaceMesh& mesh = solution.surface;
    read_triangles(piece, file, mesh);
    const ArrayReader cells{*piece.GetCellData(), file};
    for_triangle_members(
        [&](const char* name, auto member) { read_member(cells, name, mesh.triangles, member); });
    read_uvs(cells, mesh);
    read_shot_sides(cells, mesh.triangles.size(), solution.direct.shot_sides);

    const ArrayReader fields{*piece.GetFieldData(), file};
    read_trees(cells, fields, file, mesh.triangles.size(), solution.patches);
    mesh.materials.resize(fields.read_strings("MaterialName").size());
    for_material_members(
        [&](const char* name, auto member) { read_member(fields, name, mesh.materials, member); });
    read_material_textures(fields, file, mesh);
    solution.cameras.resize(fields.read_strings("CameraName").size());
    for_camera_members([&](const char* name, auto member) {
        read_member(fields, name, solution.cameras, member);
    });
    read_bin_levels(cells, file, solution);
    mesh.objects = fields.read_strings("ObjectName");
    mesh.fan_count = fields.read_value<std::uint32_t>("FanCount");
    mesh.grid.exponent = fields.read_value<std::int32_t>("GridExponent");
    mesh.grid.largest_move = fields.read_value<double>("GridLargestMove");
}

}  // namespace transillum
