/// Which patches are worth a cell in files, and in what is exported.
#pragma once

#include <transillum/solution/solution.h>

#include <cstdint>
#include <vector>

namespace transillum {

/// Patches, ascending, of the root sides that can shine and do: some leaf emits or is lit.
[[nodiscard]] std::vector<std::uint32_t> stored_patches(const Solution& solution);

}  // namespace transillum
