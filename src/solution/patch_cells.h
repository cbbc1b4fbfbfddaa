/// The patches of a solution as cells of a file.
#pragma once

#include <transillum/solution/solution.h>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace transillum {

/// One triangle a patch; the leaves of a root's side share their points; backs turn the other way
/// round. Cell arrays Root, Leaf (number within the root) and Side (0 front, 1 back) say which is
/// which.
[[nodiscard]] vtkSmartPointer<vtkPolyData> patch_cells(const Solution& solution,
                                                       const std::vector<std::uint32_t>& patches);

/// The patches of such cells.
/// \throws InputError unless they ascend and make up whole sides of roots.
[[nodiscard]] std::vector<std::uint32_t> read_patches(vtkPolyData& cells,
                                                      const PatchHierarchy& patches,
                                                      const std::filesystem::path& file);

}  // namespace transillum
