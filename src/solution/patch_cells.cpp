#include "patch_cells.h"

#include "vtk_arrays.h"

#include <transillum/base/error.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <limits>

namespace transillum {

namespace {

/// Numbers the points that the leaves of a root's side share, as they come.
class SidePoints {
public:
    SidePoints(const Solution& solution, vtkPoints& points)
        : solution_(solution), points_(points) {}

    void begin(std::uint32_t root) {
        root_ = root;
        level_ = solution_.patches.roots[root].level;
        numbers_.assign(lattice_size(level_), -1);
    }
    /// \param b in units of 2^-level of the root
    [[nodiscard]] vtkIdType number(glm::ivec2 b, int level) {
        vtkIdType& number = numbers_[lattice_number(level_, b * (1 << (level_ - level)))];
        if (number < 0) {
            const glm::dvec3 p = point_of_root(solution_.surface, root_, b, level);
            number = points_.InsertNextPoint(p.x, p.y, p.z);
        }
        return number;
    }

private:
    const Solution& solution_;
    vtkPoints& points_;
    std::uint32_t root_ = 0;
    int level_ = 0;
    std::vector<vtkIdType> numbers_;  ///< of the lattice's points; -1: none yet
};

}  // namespace

vtkSmartPointer<vtkPolyData> patch_cells(const Solution& solution,
                                         const std::vector<std::uint32_t>& stored) {
    const PatchHierarchy& patches = solution.patches;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> triangles;
    const bool fits_32_bits = stored.size() < std::numeric_limits<std::int32_t>::max() / 3;
    if (fits_32_bits) triangles->Use32BitStorage();
    const auto count = static_cast<vtkIdType>(stored.size());
    triangles->AllocateExact(count, 3 * count);

    SidePoints side(solution, *points);
    for (const std::uint32_t patch : stored) {
        const std::uint32_t leaf = patches.leaf_of_patch(patch);
        const std::uint32_t root = patches.root_of_leaf[leaf];
        if (leaf == patches.roots[root].first_leaf) side.begin(root);
        std::array<vtkIdType, 3> corners{};
        const LeafCorners barycentric = leaf_corners(patches, leaf);
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = side.number(barycentric.b[i], barycentric.level);
        if (patches.is_back(patch)) std::swap(corners[1], corners[2]);
        triangles->InsertNextCell(3, corners.data());
    }

    auto cells = vtkSmartPointer<vtkPolyData>::New();
    cells->SetPoints(points);
    cells->SetPolys(triangles);
    const auto root_of = [&](std::size_t i) {
        return patches.root_of_leaf[patches.leaf_of_patch(stored[i])];
    };
    add_array(*cells->GetCellData(), "Root", stored.size(), root_of);
    add_array(*cells->GetCellData(), "Leaf", stored.size(), [&](std::size_t i) {
        return patches.leaf_of_patch(stored[i]) - patches.roots[root_of(i)].first_leaf;
    });
    add_array(*cells->GetCellData(), "Side", stored.size(),
              [&](std::size_t i) { return std::uint8_t{patches.is_back(stored[i])}; });
    return cells;
}

std::vector<std::uint32_t> read_patches(vtkPolyData& cells, const PatchHierarchy& patches,
                                        const std::filesystem::path& file) {
    const auto count = static_cast<std::size_t>(cells.GetNumberOfCells());
    const ArrayReader reader{*cells.GetCellData(), file};
    const auto roots = reader.read<std::uint32_t>("Root", count);
    const auto leaves = reader.read<std::uint32_t>("Leaf", count);
    const auto sides = reader.read_flags("Side", count);

    std::vector<std::uint32_t> stored(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string cell = "cell " + std::to_string(i);
        if (roots[i] >= patches.roots.size()) {
            throw InputError(file.string(), cell + ": root " + std::to_string(roots[i]) + " of " +
                                                std::to_string(patches.roots.size()));
        }
        stored[i] =
            patches.roots[roots[i]].first_leaf + leaves[i] + (sides[i] ? patches.leaf_count : 0u);
        const bool begins = i == 0 || leaves[i - 1] + 1 == patches.leaves_of(roots[i - 1]);
        const bool in_order = begins ? leaves[i] == 0 && (i == 0 || stored[i] > stored[i - 1])
                                     : stored[i] == stored[i - 1] + 1;
        const bool whole = i + 1 < count || leaves[i] + 1 == patches.leaves_of(roots[i]);
        if (leaves[i] >= patches.leaves_of(roots[i]) || !in_order || !whole) {
            throw InputError(file.string(), cell + ": patches out of order or missing");
        }
    }
    return stored;
}

}  // namespace transillum
