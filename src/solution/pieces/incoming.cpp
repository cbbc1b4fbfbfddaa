#include "pieces.h"

#include "solution/stored_patches.h"
#include "solution/vtk_arrays.h"

#include <vtkCellData.h>

#include <algorithm>

namespace transillum {

namespace {

void add_rows(vtkFieldData& cells, const char* name, const std::vector<float>& table,
              std::size_t columns, const Patches& stored) {
    float* out = new_array<float>(cells, name, stored.size(), static_cast<int>(columns));
    for (const std::uint32_t patch : stored) {
        out =
            std::copy_n(table.begin() + static_cast<std::ptrdiff_t>(patch * columns), columns, out);
    }
}

std::vector<float> read_rows(const ArrayReader& reader, const char* name, std::size_t columns,
                             const Patches& stored, std::uint32_t patch_count) {
    const float* in = reader.find<float>(name, stored.size(), static_cast<int>(columns));
    std::vector<float> table(patch_count * columns, 0.0f);
    for (std::size_t i = 0; i < stored.size(); ++i) {
        std::copy_n(in + i * columns, columns,
                    table.begin() + static_cast<std::ptrdiff_t>(stored[i] * columns));
    }
    return table;
}

}  // namespace

PolyData incoming_piece(const Solution& solution, const Patches& stored) {
    PolyData piece = patch_cells(solution, stored);
    vtkCellData& cells = *piece->GetCellData();
    const DirectLight& direct = solution.direct;
    const std::size_t columns = direct.samples.size();
    add_rows(cells, "GeometryFactor", direct.geometry_factor, columns, stored);
    add_rows(cells, "Visibility", direct.visibility, columns, stored);
    return piece;
}

void read_incoming_piece(vtkPolyData& piece, const Path& file, Solution& solution) {
    const Patches stored = read_patches(piece, solution.patches, file);
    const ArrayReader reader{*piece.GetCellData(), file};
    DirectLight& direct = solution.direct;
    const std::uint32_t rows = solution.patches.patch_count();
    const std::size_t columns = direct.samples.size();
    direct.geometry_factor = read_rows(reader, "GeometryFactor", columns, stored, rows);
    direct.visibility = read_rows(reader, "Visibility", columns, stored, rows);
}

}  // namespace transillum
