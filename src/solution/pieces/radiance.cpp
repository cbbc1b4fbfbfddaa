#include "pieces.h"

#include "solution/patch_cells.h"
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

/// Direction bins: of cell i, tuples [BinOffset, BinOffset + BinCount) of the field array
/// DirectionBins hold the mean radiance that arrives from each bin, row-major over the square of
/// direction_bins.h. A patch without a lobe has none beyond its irradiance.
void add_bins(const Solution& solution, const Patches& stored, vtkPolyData& piece) {
    vtkCellData& cells = *piece.GetCellData();
    std::vector<std::uint64_t> offsets{0};
    std::vector<Spectrum> bins;
    for (const std::uint32_t p : stored) {
        if (const GlossySide* const side = solution.glossy_side(p))
            for (int k = 0; k < side->bins(); ++k)
                bins.push_back(solution.glossy_elements[side->element(k, p)]);
        offsets.push_back(bins.size());
    }
    add_array(cells, "BinOffset", stored.size(), [&](std::size_t i) { return offsets[i]; });
    add_array(cells, "BinCount", stored.size(), [&](std::size_t i) {
        return std::max(std::uint32_t{1}, static_cast<std::uint32_t>(offsets[i + 1] - offsets[i]));
    });
    if (!bins.empty())
        add_array(*piece.GetFieldData(), "DirectionBins", bins.size(),
                  [&](std::size_t j) { return bins[j]; });
}

/// \pre the solution's glossy sides are laid out.
void read_bins(vtkPolyData& piece, const Path& file, const Patches& stored, Solution& solution) {
    solution.glossy_elements.assign(solution.glossy.element_count, Spectrum(0.0f));
    std::size_t count = 0;
    for (const std::uint32_t p : stored)
        if (const GlossySide* const side = solution.glossy_side(p))
            count += static_cast<std::size_t>(side->bins());
    if (count == 0) return;
    const ArrayReader fields{*piece.GetFieldData(), file};
    const auto bins = fields.read<Spectrum>("DirectionBins", count);
    std::size_t next = 0;
    for (const std::uint32_t p : stored)
        if (const GlossySide* const side = solution.glossy_side(p))
            for (int k = 0; k < side->bins(); ++k)
                solution.glossy_elements[side->element(k, p)] = bins[next++];
}

template <class Value>
void scatter(const std::vector<Value>& values, const Patches& stored, std::uint32_t patch_count,
             std::vector<Value>& out) {
    out.assign(patch_count, Value(0));
    for (std::size_t i = 0; i < stored.size(); ++i) out[stored[i]] = values[i];
}

}  // namespace

Radiances radiances_of(const Solution& solution) {
    Radiances shown;
    for (std::uint32_t p = 0; p < solution.patches.patch_count(); ++p) {
        shown.emission.push_back(solution.emission(p));
        shown.direct.push_back(solution.direct_radiance(p));
        shown.finite_element.push_back(solution.finite_element_radiance(p));
    }
    return shown;
}

PolyData radiance_piece(const Solution& solution, const Patches& stored, const Radiances& shown) {
    PolyData piece = patch_cells(solution, stored);
    vtkCellData& cells = *piece->GetCellData();
    const auto add = [&](const char* name, auto value_of_patch) {
        add_array(cells, name, stored.size(),
                  [&](std::size_t i) { return value_of_patch(stored[i]); });
    };
    add("Radiance", [&](std::uint32_t p) {
        return shown.emission[p] + shown.direct[p] + shown.finite_element[p];
    });
    add("Emission", [&](std::uint32_t p) { return shown.emission[p]; });
    add("DirectRadiance", [&](std::uint32_t p) { return shown.direct[p]; });
    add("FiniteElementRadiance", [&](std::uint32_t p) { return shown.finite_element[p]; });
    add("DirectIrradiance", [&](std::uint32_t p) { return solution.direct_irradiance[p]; });
    add("IndirectIrradiance", [&](std::uint32_t p) { return solution.indirect_irradiance[p]; });
    add("StandardError", [&](std::uint32_t p) { return solution.standard_error[p]; });
    add("Coverage", [&](std::uint32_t p) { return solution.coverage[p]; });
    if (!solution.spatial_error.empty()) {
        add("ErrorSpatial", [&](std::uint32_t p) { return solution.spatial_error[p]; });
        add("ErrorDirectional", [&](std::uint32_t p) { return solution.directional_error[p]; });
    }
    add_provenance(solution, stored, cells);
    add_bins(solution, stored, *piece);
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
    if (reader.has("ErrorSpatial") || reader.has("ErrorDirectional")) {
        read("ErrorSpatial", solution.spatial_error);
        read("ErrorDirectional", solution.directional_error);
    }
    read_bins(piece, file, stored, solution);
}

}  // namespace transillum
