/// What the patches of a solution contribute to the iteration.
#pragma once

#include <transillum/solution/solution.h>
#include <transillum/transport/iterate.h>

namespace transillum {

/// \pre the solution's first shot and glossy sides are known.
[[nodiscard]] PatchSources make_sources(const Solution& solution);

/// Is there any light for the iteration to carry?
[[nodiscard]] bool shines(const PatchSources& sources);

}  // namespace transillum
