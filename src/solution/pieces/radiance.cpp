#include "pieces.h"

#include "solution/stored_patches.h"
#include "solution/vtk_arrays.h"

#include <vtkCellData.h>

namespace transillum {

namespace {

/// Copies of what the surface says, so that a viewer needs this piece alone.
void add_provenance(const Solution& solution, const Patches& stored, vtkFieldData& cells) {
    const PatchHierarchy& patches = solution.patches;
    const auto leaf_of = [&](std::size_t i) { return patches.leaf_of_patch(stored[i]); };
    const auto triangle = [&](std::size_t i) -> const RootTriangle& {
        return solution.surface.triangles[patches.root_of_leaf[leaf_of(i)]];
    };
    add_array(cells, "Area", stored.size(), [&](std::size_t i) {
        return static_cast<float>(area_of_leaf(solution.surface, patches, leaf_of(i)));
    });
    add_array(cells, "Level", stored.size(),
              [&](std::size_t i) { return std::int32_t{patches.level_of_leaf(leaf_of(i))}; });
    add_array(cells, "SourceObject", stored.size(),
              [&](std::size_t i) { return triangle(i).object; });
    add_array(cells, "SourceFace", stored.size(),
              [&](std::size_t i) { return triangle(i).source_face; });
    add_array(cells, "Material", stored.size(),
              [&](std::size_t i) { return triangle(i).material; });
}

/// A patch has one direction bin, so the table of further bins is empty.
void add_bins(std::size_t count, vtkFieldData& cells) {
    add_array(cells, "BinOffset", count, [](std::size_t) { return std::uint32_t{0}; });
    add_array(cells, "BinCount", count, [](std::size_t) { return std::uint32_t{1}; });
}

template <class Value>
void scatter(const std::vector<Value>& values, const Patches& stored, std::uint32_t patch_count,
             std::vector<Value>& out) {
    out.assign(patch_count, Value(0));
    for (std::size_t i = 0; i < stored.size(); ++i) out[stored[i]] = values[i];
}

}  // namespace

PolyData radiance_piece(const Solution& solution, const Patches& stored) {
    PolyData piece = patch_cells(solution, stored);
    vtkCellData& cells = *piece->GetCellData();
    const auto add = [&](const char* name, auto value_of_patch) {
        add_array(cells, name, stored.size(),
                  [&](std::size_t i) { return value_of_patch(stored[i]); });
    };
    add("Radiance", [&](std::uint32_t p) {
        return solution.emission(p) + solution.direct_radiance(p) +
               solution.finite_element_radiance(p);
    });
    add("Emission", [&](std::uint32_t p) { return solution.emission(p); });
    add("DirectRadiance", [&](std::uint32_t p) { return solution.direct_radiance(p); });
    add("FiniteElementRadiance",
        [&](std::uint32_t p) { return solution.finite_element_radiance(p); });
    add("DirectIrradiance", [&](std::uint32_t p) { return solution.direct_irradiance[p]; });
    add("IndirectIrradiance", [&](std::uint32_t p) { return solution.indirect_irradiance[p]; });
    add("StandardError", [&](std::uint32_t p) { return solution.standard_error[p]; });
    add("Coverage", [&](std::uint32_t p) { return solution.coverage[p]; });
    add_provenance(solution, stored, cells);
    add_bins(stored.size(), cells);
    cells.SetActiveScalars("Radiance");
    return piece;
}

void read_radiance_piece(vtkPolyData& piece, const Path& file, Solution& solution) {
    const Patches stored = read_patches(piece, solution.patches, file);
    const ArrayReader reader{*piece.GetCellData(), file};
    const auto read = [&]<class Value>(const char* name, std::vector<Value>& out) {
        scatter(reader.read<Value>(name, stored.size()), stored, solution.patches.patch_count(),
                out);
    };
    read("DirectIrradiance", solution.direct_irradiance);
    read("IndirectIrradiance", solution.indirect_irradiance);
    read("StandardError", solution.standard_error);
    read("Coverage", solution.coverage);
}

}  // namespace transillum
