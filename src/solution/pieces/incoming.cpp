#include "pieces.h"

#include "solution/patch_cells.h"
#include "solution/vtk_arrays.h"

#include <vtkCellData.h>

#include <cstring>

namespace transillum {

namespace {

/// Floats, or vectors of them.
template <class Value>
void add_rows(vtkFieldData& cells, const char* name, const std::vector<Value>& table,
              std::size_t columns, const Patches& stored) {
    const std::size_t parts = columns * part_count<Value>;
    float* out = new_array<float>(cells, name, stored.size(), static_cast<int>(parts));
    for (const std::uint32_t patch : stored) {
        std::memcpy(out, &table[patch * columns], parts * sizeof(float));
        out += parts;
    }
}

template <class Value>
std::vector<Value> read_rows(const ArrayReader& reader, const char* name, std::size_t columns,
                             const Patches& stored, std::uint32_t patch_count) {
    const std::size_t parts = columns * part_count<Value>;
    const float* in = reader.find<float>(name, stored.size(), static_cast<int>(parts));
    std::vector<Value> table(patch_count * columns, Value(0.0f));
    for (std::size_t i = 0; i < stored.size(); ++i)
        std::memcpy(&table[stored[i] * columns], in + i * parts, parts * sizeof(float));
    return table;
}

}  // namespace

PolyData incoming_piece(const Solution& solution, const Patches& stored) {
    PolyData piece = patch_cells(solution, stored);
    vtkCellData& cells = *piece->GetCellData();
    const DirectLight& direct = solution.direct;
    const std::size_t columns = direct.columns();
    if (direct.has_vectors()) {
        add_array(*piece->GetFieldData(), "FirstSample", columns,
                  [&](std::size_t i) { return direct.first_samples[i]; });
        add_rows(cells, "LightVector", direct.vectors, columns, stored);
        return piece;
    }
    add_value(*piece->GetFieldData(), "ViewPixel", direct.view_pixel);
    add_value(*piece->GetFieldData(), "ParallelPixel", direct.parallel_pixel);
    add_rows(cells, "GeometryFactor", direct.geometry_factor, columns, stored);
    add_rows(cells, "Visibility", direct.visibility, columns, stored);
    return piece;
}

void read_incoming_piece(vtkPolyData& piece, const Path& file, Solution& solution) {
    const Patches stored = read_patches(piece, solution.patches, file);
    const ArrayReader reader{*piece.GetCellData(), file};
    DirectLight& direct = solution.direct;
    const std::uint32_t rows = solution.patches.patch_count();
    const ArrayReader fields{*piece.GetFieldData(), file};
    if (fields.has("FirstSample")) direct.first_samples = fields.read<std::uint32_t>("FirstSample");
    const std::size_t columns = direct.columns();
    if (direct.has_vectors()) {
        direct.vectors = read_rows<glm::vec3>(reader, "LightVector", columns, stored, rows);
        return;
    }
    direct.view_pixel = fields.read_value<double>("ViewPixel");
    direct.parallel_pixel = fields.read_value<double>("ParallelPixel");
    direct.geometry_factor = read_rows<float>(reader, "GeometryFactor", columns, stored, rows);
    direct.visibility = read_rows<float>(reader, "Visibility", columns, stored, rows);
}

}  // namespace transillum
